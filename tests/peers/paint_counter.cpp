// Preloaded into mrview by mrview-glyphs and mrview-tracts: counts how often it paints. mrview draws each glyph by
// glDrawElements and streamlines by glMultiDrawArrays or glMultiDrawElements, takes its OpenGL functions from
// glXGetProcAddressARB and clears before each paint; so a paint is a run of many draws between clears. At the end it appends to
// the file named by PAINT_COUNTER one line per such run: the number of draws.
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using Function = void (*)();
using GetProcAddress = Function (*)(const unsigned char*);
using Clear = void (*)(unsigned);
using DrawElements = void (*)(unsigned, int, unsigned, const void*);
using MultiDrawArrays = void (*)(unsigned, const int*, const int*, int);
using MultiDrawElements = void (*)(unsigned, const int*, unsigned, const void* const*, int);

Clear next_clear = nullptr;
DrawElements next_draw = nullptr;
MultiDrawArrays next_arrays = nullptr;
MultiDrawElements next_elements = nullptr;

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

void drawArrays(unsigned mode, const int* first, const int* count, int draws) {
    counter().draws += draws;
    next_arrays(mode, first, count, draws);
}

void drawElements(unsigned mode, const int* count, unsigned type, const void* const* indices, int draws) {
    counter().draws += draws;
    next_elements(mode, count, type, indices, draws);
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
    if (std::strcmp(text, "glMultiDrawArrays") == 0) {
        next_arrays = reinterpret_cast<MultiDrawArrays>(found);
        return reinterpret_cast<Function>(&drawArrays);
    }
    if (std::strcmp(text, "glMultiDrawElements") == 0) {
        next_elements = reinterpret_cast<MultiDrawElements>(found);
        return reinterpret_cast<Function>(&drawElements);
    }
    return found;
}
