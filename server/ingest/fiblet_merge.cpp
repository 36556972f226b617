#include "ingest/fiblet_merge.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "base/error.h"
#include "build/fiblet_pages.h"
#include "io/fiblet_writer.h"

namespace radiata::ingest {
namespace {

/// A run's records one after another.
class Cursor {
public:
    Cursor(const ScratchFile& file, const StoredRun& run, std::size_t columns, std::size_t buffer_bytes)
        : file_(file), next_(run.records), end_(run.numbers), columns_(columns), room_(buffer_bytes) {}

    bool done() const { return begin_ == buffer_.size() && next_ == end_; }
    std::uint64_t morton() {
        std::uint64_t code = 0;
        std::memcpy(&code, bytes(sizeof code).data(), sizeof code);
        return code;
    }
    /// Takes the record.
    void moveTo(model::FibletSet& set) {
        model::FibletHead head;
        const std::size_t fixed = 8 + sizeof head;
        std::memcpy(&head, bytes(fixed).data() + 8, sizeof head);
        words_.resize(wordsOf(head));
        const std::span<const std::byte> all = bytes(fixed + 4 * words_.size() + 72 * columns_);
        std::memcpy(words_.data(), all.data() + fixed, 4 * words_.size());
        appendFiblet(set, head, words_.data());
        const std::byte* at = all.data() + fixed + 4 * words_.size();
        for (std::size_t c = 0; c < columns_; ++c, at += 72) {
            model::PointColumn& column = set.point_columns[c];
            std::memcpy(static_cast<void*>(&column.ranges.emplace_back()), at, 8);
            column.values.insert(column.values.end(), reinterpret_cast<const std::uint8_t*>(at) + 8,
                                 reinterpret_cast<const std::uint8_t*>(at) + 72);
        }
        begin_ += all.size();
    }

private:
    /// The next ones, which stay there until they are taken.
    std::span<const std::byte> bytes(std::size_t count) {
        if (buffer_.size() - begin_ < count) {
            buffer_.erase(buffer_.begin(), buffer_.begin() + std::ptrdiff_t(begin_));
            begin_ = 0;
            const std::size_t kept = buffer_.size();
            buffer_.resize(std::size_t(std::min<std::uint64_t>(std::max(room_, count), kept + (end_ - next_))));
            const std::span<std::byte> fresh = std::span(buffer_).subspan(kept);
            if (buffer_.size() < count || file_.read(next_, fresh) < fresh.size())
                throw Error(Code::kCorrupt, file_.path().string() + ": was changed by somebody else; delete it");
            next_ += fresh.size();
        }
        return std::span(buffer_).subspan(begin_, count);
    }

    const ScratchFile& file_;
    std::uint64_t next_, end_;
    std::size_t columns_, room_, begin_ = 0;
    std::vector<std::byte> buffer_;
    std::vector<std::uint32_t> words_;
};

template <typename T>
std::vector<T> readArray(const ScratchFile& file, std::uint64_t at, std::uint64_t count) {
    std::vector<T> values(count);
    if (file.read(at, std::as_writable_bytes(std::span(values))) < count * sizeof(T))
        throw Error(Code::kCorrupt, file.path().string() + ": was changed by somebody else; delete it");
    return values;
}

/// For each run, the places in the file of its records, in their order; kept behind the runs.
class Places {
public:
    Places(FibletRuns& runs, std::size_t buffer) : file_(runs.file()), room_(buffer / 4) {
        std::uint64_t at = runs.end();
        for (const StoredRun& run : runs.runs()) {
            own_.push_back({at, at, {}});
            at += 4 * run.sums.fiblets;
        }
    }
    void add(std::size_t run, std::uint32_t place) {
        own_[run].buffer.push_back(place);
        if (own_[run].buffer.size() >= room_) flush(own_[run]);
    }
    void flush() {
        for (Own& own : own_) flush(own);
    }
    std::uint64_t begin(std::size_t run) const { return own_[run].begin; }

private:
    struct Own {
        std::uint64_t begin = 0, end = 0;
        std::vector<std::uint32_t> buffer;
    };
    void flush(Own& own) {
        file_.write(own.end, std::as_bytes(std::span(own.buffer)));
        own.end += 4 * own.buffer.size();
        own.buffer.clear();
    }

    ScratchFile& file_;
    std::size_t room_;
    std::vector<Own> own_;
};

class Merge {
public:
    Merge(FibletRuns& runs, const model::FibletSet& set, std::uint64_t memory_bytes, const std::filesystem::path& out)
        : runs_(runs),
          set_(set),
          share_(std::clamp<std::uint64_t>(memory_bytes / 4 / std::max<std::size_t>(runs.runs().size(), 1), 4096, 1 << 22)),
          pages_(
              std::clamp<std::uint64_t>(memory_bytes / 8 / (shader::FIBLET_PAGE * (100 + 72 * runs.pointColumns())), 1, 2048)),
          writer_(out, set, {runs.sums().fibres, runs.sums().fiblets, runs.sums().words}) {}

    void pages(const FibletProgress& progress) {
        using Next = std::pair<std::uint64_t, std::size_t>;
        std::vector<Cursor> cursors;
        std::priority_queue<Next, std::vector<Next>, std::greater<>> queue;
        for (std::size_t r = 0; r < runs_.runs().size(); ++r) {
            cursors.emplace_back(runs_.file(), runs_.runs()[r], runs_.pointColumns(), share_);
            if (!cursors[r].done()) queue.emplace(cursors[r].morton(), r);
        }
        Places places(runs_, share_);
        model::FibletSet chunk;
        clear(chunk);
        for (std::uint32_t place = 0; !queue.empty(); ++place) {
            const std::size_t r = queue.top().second;
            queue.pop();
            cursors[r].moveTo(chunk);
            places.add(r, place);
            if (!cursors[r].done()) queue.emplace(cursors[r].morton(), r);
            if (chunk.heads.size() < pages_ * shader::FIBLET_PAGE) continue;
            put(chunk);
            if (progress) progress(double(place) / double(runs_.sums().fiblets));
        }
        put(chunk);
        places.flush();
        cursors.clear();
        for (std::size_t r = 0; r < runs_.runs().size(); ++r) fibreFiblets(runs_.runs()[r], places.begin(r));
    }

    void fibres() {
        std::uint32_t first = 0;
        for (const StoredRun& run : runs_.runs()) {
            std::vector<std::uint32_t> firsts = readArray<std::uint32_t>(runs_.file(), run.fiblets, run.sums.fibres);
            for (std::uint32_t& count : firsts) first += std::exchange(count, first);
            writer_.addFibreFirst(firsts);
            std::uint64_t at = run.columns;
            for (std::size_t c = 0; c < set_.fibre_columns.size(); ++c) {
                const std::uint64_t count = run.sums.fibres * set_.fibre_columns[c].components;
                writer_.addFibreColumn(c, readArray<float>(runs_.file(), at, count));
                at += 4 * count;
            }
        }
        writer_.addFibreFirst({&first, 1});
    }

    void finish() { writer_.finish(); }

private:
    void clear(model::FibletSet& chunk) const {
        chunk = {};
        chunk.codec = set_.codec;
        chunk.point_columns.resize(runs_.pointColumns());
    }
    void put(model::FibletSet& chunk) {
        chunk.codes.push_back(0);
        boundFiblets(chunk);
        writer_.addPages(chunk);
        clear(chunk);
    }
    /// The fiblets of a run's fibres, in order: places, which lie in the order of the records, put where the numbers say.
    void fibreFiblets(const StoredRun& run, std::uint64_t places_at) {
        const auto numbers = readArray<std::uint32_t>(runs_.file(), run.numbers, run.sums.fiblets);
        const auto places = readArray<std::uint32_t>(runs_.file(), places_at, run.sums.fiblets);
        std::vector<std::uint32_t> own(numbers.size());
        for (std::size_t i = 0; i < numbers.size(); ++i) own[numbers[i]] = places[i];
        writer_.addFibreFiblets(own);
    }

    FibletRuns& runs_;
    const model::FibletSet& set_;
    std::size_t share_;
    std::uint64_t pages_;
    io::FibletWriter writer_;
};

}  // namespace

void mergeRuns(FibletRuns& runs, const model::FibletSet& set, std::uint64_t memory_bytes, const std::filesystem::path& out,
               const FibletProgress& progress) {
    requireFibletRoom(runs.sums().fiblets, runs.sums().words, set.source);
    Merge merge(runs, set, memory_bytes, out);
    merge.pages(progress);
    merge.fibres();
    merge.finish();
}

}  // namespace radiata::ingest
