// Whole illumination lattices that were saved, on their way from the disk to the device: read on any thread, so that nobody
// waits who has not asked for them, and handed over to the one that renders.
#pragma once

#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <optional>

#include "base/error.h"
#include "io/lattice_file.h"

namespace radiata::store {

/// Thread-safe: one file is read at a time, and who only asks does not wait for it.
class SavedLattices {
public:
    /// Whether nothing is left to read: there is no such file, or it was read since forget().
    bool resident(const std::filesystem::path& file) const;
    /// Reads it unless it is resident. What is wrong with it is said by take(). \param wanted  what it must say of itself
    void read(const std::filesystem::path& file, const io::LatticeHeader& wanted);
    /// What the file holds, read now if it was not; from then on it is the caller's alone. Null if there is no such file.
    /// \throws Error of io::readLattice
    std::shared_ptr<const io::SavedLattice> take(const std::filesystem::path& file, const io::LatticeHeader& wanted);
    /// Who took it has it no more: it is read again when it is wanted.
    void forget(const std::filesystem::path& file);

private:
    struct Entry {
        std::filesystem::path file;
        std::shared_ptr<const io::SavedLattice> lattice;  ///< null: taken, or not readable
        std::optional<Error> failure;
    };
    std::list<Entry>::iterator find(const std::filesystem::path& file);

    std::mutex reading_;        ///< held while a file is read, before mutex_
    mutable std::mutex mutex_;  ///< of the list
    std::list<Entry> known_;    ///< latest first
};

}  // namespace radiata::store
