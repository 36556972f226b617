#include "io/fiblet_check.h"

#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "io/fiblet_layout.h"

namespace radiata::io {
namespace {

class Check {
public:
    Check(const model::FibletSet& set, std::uint64_t words, const std::string& name) : set_(set), words_(words), name_(name) {}

    void codec() const {
        const shader::FibletCodec& codec = set_.codec;
        require(std::isfinite(codec.cell_mm) && codec.cell_mm > 0, "cells have " + std::to_string(codec.cell_mm) + " mm");
        require(std::isfinite(codec.step_mm) && codec.step_mm > 0, "steps have " + std::to_string(codec.step_mm) + " mm");
        for (const float ratio : codec.cap_ratio)
            require(ratio > 0 && ratio <= 2, "a cap has the ratio " + std::to_string(ratio));
        const glm::dvec3 o = set_.origin_mm;
        const double most = model::kCoordinateMaxMm;
        require(std::abs(o.x) <= most && std::abs(o.y) <= most && std::abs(o.z) <= most && double(codec.step_mm) <= most &&
                    double(codec.cell_mm) * model::kFibletCellMax <= 2.01 * most,
                "points lie farther than " + std::to_string(most) + " mm from the scanner's centre");
    }

    void pages() const {
        const std::uint64_t count = (set_.heads.size() + shader::FIBLET_PAGE - 1) / shader::FIBLET_PAGE;
        require(set_.pages.size() == count, "there are " + std::to_string(set_.pages.size()) + " pages for " +
                                                std::to_string(set_.heads.size()) + " fiblets; it would have to be " +
                                                std::to_string(count));
        for (std::size_t p = 0; p < count; ++p) {
            const shader::FibletPage& page = set_.pages[p];
            const std::uint64_t first = p * shader::FIBLET_PAGE,
                                own = std::min<std::uint64_t>(shader::FIBLET_PAGE, set_.heads.size() - first);
            const std::uint64_t end = p + 1 < count ? set_.pages[p + 1].first_word : words_;
            require(page.count == own, "page " + std::to_string(p) + " says " + std::to_string(page.count) +
                                           " fiblets, but has " + std::to_string(own));
            require(page.first_word <= end && end <= words_ && (p > 0 || page.first_word == 0),
                    "page " + std::to_string(p) + " has its codes from word " + std::to_string(page.first_word) + " to " +
                        std::to_string(end) + " of " + std::to_string(words_));
        }
    }

    void head(std::size_t f) const {
        const model::FibletHead& head = set_.heads[f];
        const std::size_t p = f / shader::FIBLET_PAGE;
        const std::uint64_t own = fiblet::pageWords(set_.pages, p, words_);
        const std::uint32_t words =
            model::fibletWords(model::fibletSegments(head), model::fibletWidth(head), model::fibletIsShortened(head));
        require(model::fibletWord(head) + words <= own, "the codes of fiblet " + std::to_string(f) + " end behind its page's");
        require(head.fibre < set_.fibres(), "fiblet " + std::to_string(f) + " is of fibre " + std::to_string(head.fibre) +
                                                " of " + std::to_string(set_.fibres()));
        const std::uint32_t first = set_.fibre_first[head.fibre], count = set_.fibre_first[head.fibre + 1] - first;
        const std::uint32_t index = model::fibletIndex(head);
        require(index < count && set_.fibre_fiblets[first + index] == f,
                "fiblet " + std::to_string(f) + " is number " + std::to_string(index) + " of fibre " +
                    std::to_string(head.fibre) + ", but the index says otherwise");
        const bool last = index + 1 == count;
        require(model::fibletIsLast(head) == last && (last || model::fibletSegments(head) == shader::FIBLET_SEGMENTS) &&
                    (last || !model::fibletIsShortened(head)),
                "fiblet " + std::to_string(f) + " is " + (last ? "" : "not ") +
                    "the last of its fibre, which its flags or length contradict");
    }

    void index() const {
        require(
            set_.fibre_first.front() == 0 && set_.fibre_first.back() == set_.heads.size(),
            "the index names " + std::to_string(set_.fibre_first.back()) + " fiblets of " + std::to_string(set_.heads.size()));
        for (std::size_t f = 0; f + 1 < set_.fibre_first.size(); ++f) {
            require(set_.fibre_first[f] <= set_.fibre_first[f + 1],
                    "the fiblets of fibre " + std::to_string(f) + " end before they begin");
        }
    }

private:
    void require(bool right, const std::string& wrong) const {
        if (!right) throw Error(Code::kCorrupt, name_ + ": " + wrong);
    }

    const model::FibletSet& set_;
    std::uint64_t words_;
    const std::string& name_;
};

}  // namespace

void checkFiblets(const model::FibletSet& set, std::uint64_t words, const std::string& name) {
    const Check check(set, words, name);
    check.codec();
    check.index();
    check.pages();
    parallelFor(set.heads.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) check.head(f);
    });
}

}  // namespace radiata::io
