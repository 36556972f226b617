#include "store/saved_lattices.h"

#include <algorithm>
#include <utility>

namespace radiata::store {
namespace {

/// Lattices in host memory that nobody took yet: who asked for older ones looks at something else by now.
constexpr int kWaiting = 2;

bool isThere(const std::filesystem::path& file) {
    std::error_code failure;
    return !file.empty() && std::filesystem::is_regular_file(file, failure);
}

}  // namespace

std::list<SavedLattices::Entry>::iterator SavedLattices::find(const std::filesystem::path& file) {
    return std::ranges::find(known_, file, &Entry::file);
}

bool SavedLattices::resident(const std::filesystem::path& file) const {
    if (!isThere(file)) return true;
    std::lock_guard lock(mutex_);
    return std::ranges::find(known_, file, &Entry::file) != known_.end();
}

void SavedLattices::read(const std::filesystem::path& file, const io::LatticeHeader& wanted) {
    std::lock_guard reading(reading_);
    if (resident(file)) return;
    Entry entry{file, nullptr, {}};
    try {
        entry.lattice = std::make_shared<const io::SavedLattice>(io::readLattice(file, wanted));
    } catch (const Error& error) {
        entry.failure = error;
    }
    std::lock_guard lock(mutex_);
    known_.push_front(std::move(entry));
    int waiting = 0;
    std::erase_if(known_, [&](const Entry& one) { return one.lattice && ++waiting > kWaiting; });
}

std::shared_ptr<const io::SavedLattice> SavedLattices::take(const std::filesystem::path& file,
                                                            const io::LatticeHeader& wanted) {
    if (!isThere(file)) return nullptr;
    for (;;) {
        read(file, wanted);
        std::lock_guard lock(mutex_);
        const auto entry = find(file);
        if (entry == known_.end()) continue;  // others were read meanwhile
        if (entry->failure) throw Error(*entry->failure);
        if (entry->lattice) return std::exchange(entry->lattice, nullptr);
        known_.erase(entry);  // taken before, by a lattice that is gone
    }
}

void SavedLattices::forget(const std::filesystem::path& file) {
    std::lock_guard lock(mutex_);
    const auto entry = find(file);
    if (entry != known_.end()) known_.erase(entry);
}

}  // namespace radiata::store
