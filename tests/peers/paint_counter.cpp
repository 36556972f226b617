// Preloaded into mrview by mrview-glyphs: counts how often it paints its glyphs. mrview draws each glyph by glDrawElements,
// takes its OpenGL functions from glXGetProcAddressARB and clears before each paint; so a paint is a run of many draws between
// clears. At the end it appends to the file named by PAINT_COUNTER one line per such run: the number of draws.
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using Function = void (*)();
using GetProcAddress = Function (*)(const unsigned char*);
using Clear = void (*)(unsigned);
using DrawElements = void (*)(unsigned, int, unsigned, const void*);

Clear next_clear = nullptr;
DrawElements next_draw = nullptr;

struct Counter {
    long draws = 0;
    FILE* file = std::fopen(std::getenv("PAINT_COUNTER") ? std::getenv("PAINT_COUNTER") : "/dev/null", "a");
    void flush() {
        if (draws > 0 && file != nullptr) {
            std::fprintf(file, "%ld\n", draws);
            std::fflush(file);
        }
        draws = 0;
    }
    ~Counter() { flush(); }
};

Counter& counter() {
    static Counter one;
    return one;
}

void clear(unsigned mask) {
    counter().flush();
    next_clear(mask);
}

void draw(unsigned mode, int count, unsigned type, const void* indices) {
    ++counter().draws;
    next_draw(mode, count, type, indices);
}

}  // namespace

extern "C" Function glXGetProcAddressARB(const unsigned char* name) {
    static const auto next = reinterpret_cast<GetProcAddress>(dlsym(RTLD_NEXT, "glXGetProcAddressARB"));
    const Function found = next(name);
    const char* text = reinterpret_cast<const char*>(name);
    if (std::strcmp(text, "glClear") == 0) {
        next_clear = reinterpret_cast<Clear>(found);
        return reinterpret_cast<Function>(&clear);
    }
    if (std::strcmp(text, "glDrawElements") == 0) {
        next_draw = reinterpret_cast<DrawElements>(found);
        return reinterpret_cast<Function>(&draw);
    }
    return found;
}
