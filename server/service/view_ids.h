// Names of open views: 128 random bits, so that nobody can steer a view that is not theirs.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <unordered_map>

namespace radiata::service {

/// Thread-safe.
class ViewIds {
public:
    /// 32 hexadecimal digits from the system's random source.
    std::string add(std::uint64_t view);
    void remove(const std::string& id);
    /// \throws Error(kNotFound)
    std::uint64_t find(const std::string& id) const;

private:
    mutable std::mutex mutex_;
    std::unordered_map<std::string, std::uint64_t> views_;
};

}  // namespace radiata::service
