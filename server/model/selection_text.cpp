#include "model/selection_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/error.h"

namespace radiata::model {
namespace {

bool isWord(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == '-' ||
           c == '+';
}

class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    FibreRegion parseRegion() {
        region_only_ = true;
        FibreRegion only = region();
        skipBlanks();
        if (at_ < text_.size()) fail("the end");
        return only;
    }

    Selection parse() {
        if (text_.size() > kSelectionTextMax) {
            throw Error(Code::kInvalidArgument, "selection has " + std::to_string(text_.size()) + " characters; at most " +
                                                    std::to_string(kSelectionTextMax) + " are read");
        }
        Selection selection = anyOf(0);
        skipBlanks();
        if (at_ < text_.size()) fail("'and', 'or' or the end");
        return selection;
    }

private:
    [[noreturn]] void fail(const std::string& wanted) const {
        std::string there(text_.substr(at_, 20));
        for (char& c : there) {
            if (c < ' ' || c > '~') c = '?';
        }
        throw Error(Code::kInvalidArgument, "selection, at character " + std::to_string(at_ + 1) + ": " +
                                                (there.empty() ? "the text ends" : "'" + there + "'") + " where " + wanted +
                                                " should be");
    }

    void skipBlanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
            ++at_;
    }

    bool takeChar(char c) {
        skipBlanks();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    std::string_view peekWord() {
        skipBlanks();
        std::size_t end = at_;
        while (end < text_.size() && isWord(text_[end])) ++end;
        return text_.substr(at_, end - at_);
    }

    bool takeWord(std::string_view word) {
        if (peekWord() != word) return false;
        at_ += word.size();
        return true;
    }

    void require(char c) {
        if (!takeChar(c)) fail("'" + std::string(1, c) + "'");
    }

    double number() {
        const std::string_view word = peekWord();
        const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
        double value = 0;
        const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (failure != std::errc() || end != digits.data() + digits.size() || std::isnan(value)) fail("a number");
        at_ += word.size();
        return value;
    }

    double finiteNumber() {
        const std::size_t before = at_;
        const double value = number();
        if (!std::isfinite(value)) {
            at_ = before;
            fail("a finite number");
        }
        return value;
    }

    std::uint64_t whole(std::uint64_t most) {
        const std::string_view word = peekWord();
        const std::string_view digits = word.substr(0, word.find('-'));
        std::uint64_t value = 0;
        const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (failure != std::errc() || end != digits.data() + digits.size() || value > most) {
            fail("a whole number up to " + std::to_string(most));
        }
        at_ += digits.size();
        return value;
    }

    std::string name() {
        if (takeChar('"')) {
            const std::size_t end = text_.find('"', at_);
            if (end == text_.npos) fail("a name that ends with '\"'");
            const std::string quoted(text_.substr(at_, end - at_));
            at_ = end + 1;
            if (quoted.empty()) fail("a name that is not empty");
            return quoted;
        }
        const std::string word(peekWord());
        if (word.empty()) fail("a name");
        at_ += word.size();
        return word;
    }

    /// Finite numbers up to the closing parenthesis.
    std::vector<double> numbers() {
        std::vector<double> list;
        require('(');
        do list.push_back(finiteNumber());
        while (list.size() < 64 && takeChar(','));
        require(')');
        return list;
    }

    Selection joined(Selection::Kind kind, std::string_view word, int depth, Selection (Parser::*part)(int)) {
        Selection first = (this->*part)(depth);
        if (peekWord() != word) return first;
        Selection all;
        all.kind = kind;
        all.children.push_back(std::move(first));
        while (takeWord(word)) all.children.push_back((this->*part)(depth));
        return all;
    }

    Selection anyOf(int depth) { return joined(Selection::Kind::kOr, "or", depth, &Parser::allOf); }
    Selection allOf(int depth) { return joined(Selection::Kind::kAnd, "and", depth, &Parser::factor); }

    Selection factor(int depth) {
        if (depth > kSelectionDepthMax) fail("a selection nested less than " + std::to_string(kSelectionDepthMax) + " deep");
        if (takeWord("not")) {
            Selection selection;
            selection.kind = Selection::Kind::kNot;
            selection.children.push_back(factor(depth + 1));
            return selection;
        }
        if (takeChar('(')) {
            Selection selection = anyOf(depth + 1);
            require(')');
            return selection;
        }
        return predicate();
    }

    Selection predicate() {
        Selection selection;
        if (takeWord("everything")) return selection;
        if (takeWord("order")) return ordered();
        if (takeWord("length")) {
            selection.kind = Selection::Kind::kLength;
            require('(');
            bounds(selection);
            require(')');
            return selection;
        }
        if (takeWord("column")) return column();
        if (takeWord("group")) {
            selection.kind = Selection::Kind::kGroup;
            require('(');
            selection.name = name();
            require(')');
            return selection;
        }
        if (takeWord("fibres")) return fibres();
        if (takeWord("share")) return drawn(Selection::Kind::kShare);
        if (takeWord("sample")) return drawn(Selection::Kind::kSample);
        return inRegion();
    }

    void bounds(Selection& selection) {
        selection.low = number();
        require(',');
        selection.high = number();
        if (selection.low > selection.high) fail("a higher bound than the lower one before");
    }

    Selection column() {
        Selection selection;
        selection.kind = Selection::Kind::kColumn;
        require('(');
        selection.name = name();
        require(',');
        bounds(selection);
        if (takeChar(',')) {
            if (takeWord("least")) {
                selection.part = ColumnPart::kLeast;
            } else if (takeWord("largest")) {
                selection.part = ColumnPart::kLargest;
            } else if (!takeWord("mean")) {
                fail("mean, least or largest");
            }
        }
        require(')');
        return selection;
    }

    Selection fibres() {
        Selection selection;
        selection.kind = Selection::Kind::kFibres;
        require('(');
        do {
            const auto first = static_cast<std::uint32_t>(whole(0xffffffffU));
            auto last = first;
            if (takeChar('-')) last = static_cast<std::uint32_t>(whole(0xffffffffU));
            if (last < first) fail("a range that ascends");
            selection.ranges.emplace_back(first, last);
        } while (takeChar(','));
        require(')');
        return selection;
    }

    Selection drawn(Selection::Kind kind) {
        Selection selection;
        selection.kind = kind;
        require('(');
        selection.amount = finiteNumber();
        const bool sample = kind == Selection::Kind::kSample;
        if (!(selection.amount >= 0 && selection.amount <= (sample ? 4294967295.0 : 1.0)) ||
            (sample && selection.amount != std::floor(selection.amount))) {
            fail(sample ? "a count of fibres" : "a share from 0 to 1");
        }
        if (takeChar(',')) selection.seed = whole(~std::uint64_t{0});
        require(')');
        return selection;
    }

    Selection ordered() {
        Selection selection;
        selection.kind = Selection::Kind::kOrdered;
        require('(');
        do selection.regions.push_back(region());
        while (selection.regions.size() < 64 && takeChar(','));
        if (selection.regions.size() < 2) fail("a second region");
        require(')');
        return selection;
    }

    Selection inRegion() {
        Selection selection;
        selection.kind = Selection::Kind::kRegion;
        if (takeWord("all")) {
            selection.mode = RegionMode::kAll;
        } else if (takeWord("either_end")) {
            selection.mode = RegionMode::kEitherEnd;
        } else if (takeWord("both_ends")) {
            selection.mode = RegionMode::kBothEnds;
        } else {
            takeWord("any");
        }
        selection.regions.push_back(region());
        return selection;
    }

    FibreRegion region() {
        FibreRegion region;
        if (takeWord("mask")) {
            region.shape = RegionShape::kMask;
            require('(');
            region.dataset = name();
            if (takeChar(',')) region.threshold = finiteNumber();
            require(')');
            return region;
        }
        if (takeWord("mesh")) {
            region.shape = RegionShape::kMesh;
            require('(');
            region.dataset = name();
            require(')');
            return region;
        }
        if (takeWord("sphere")) {
            const std::vector<double> n = numbersOf(4, 4, "sphere(x, y, z, radius)");
            region.centre = {n[0], n[1], n[2]};
            region.axes = glm::dmat3(n[3]);
            if (!(n[3] > 0)) fail("a radius above 0 before this");
        } else if (takeWord("box")) {
            const std::vector<double> n = numbersOf(6, 6, "box(x0, y0, z0, x1, y1, z1)");
            region.shape = RegionShape::kBox;
            region.centre = glm::min(glm::dvec3(n[0], n[1], n[2]), glm::dvec3(n[3], n[4], n[5]));
            region.high = glm::max(glm::dvec3(n[0], n[1], n[2]), glm::dvec3(n[3], n[4], n[5]));
        } else if (takeWord("plane")) {
            const std::vector<double> n = numbersOf(6, 6, "plane(px, py, pz, nx, ny, nz)");
            region.shape = RegionShape::kHalfSpace;
            region.centre = {n[0], n[1], n[2]};
            region.high = {n[3], n[4], n[5]};
            if (region.high == glm::dvec3(0)) fail("a normal that is not zero before this");
        } else if (takeWord("ellipsoid")) {
            ellipsoid(region);
        } else {
            if (region_only_) fail("a region (sphere, box, ellipsoid, plane, mask, mesh)");
            fail(
                "a region or filter (sphere, box, ellipsoid, plane, mask, mesh, order, length, column, group, fibres, share, "
                "sample)");
        }
        return region;
    }

    std::vector<double> numbersOf(std::size_t one, std::size_t other, const char* form) {
        const std::size_t before = at_;
        std::vector<double> list = numbers();
        if (list.size() == one || list.size() == other) return list;
        at_ = before;
        fail(form);
    }

    void ellipsoid(FibreRegion& region) {
        const std::vector<double> n = numbersOf(6, 12, "ellipsoid(x, y, z, a, b, c) or one with three half axes");
        region.centre = {n[0], n[1], n[2]};
        if (n.size() == 6) {
            region.axes = glm::dmat3(n[3], 0, 0, 0, n[4], 0, 0, 0, n[5]);
        } else {
            for (int i = 0; i < 9; ++i) region.axes[i / 3][i % 3] = n[static_cast<std::size_t>(3 + i)];
        }
        // Of units, as products of lengths over- and underflow.
        glm::dmat3 units(0.0);
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3& axis = region.axes[i];
            const double length = std::hypot(axis.x, axis.y, axis.z);
            if (length > 0) units[i] = axis / length;
        }
        if (!(std::abs(glm::determinant(units)) > 1e-9)) fail("three half axes that span space before this");
    }

    std::string_view text_;
    std::size_t at_ = 0;
    bool region_only_ = false;  ///< filters are nothing to cut with
};

std::string exact(double value) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string exact(const glm::dvec3& v) { return exact(v.x) + "," + exact(v.y) + "," + exact(v.z); }

}  // namespace

Selection parseSelection(std::string_view text) { return Parser(text).parse(); }

FibreRegion parseRegion(std::string_view text) { return Parser(text.substr(0, kSelectionTextMax)).parseRegion(); }

std::string regionText(const FibreRegion& region) {
    switch (region.shape) {
        case RegionShape::kEllipsoid:
            return "ellipsoid(" + exact(region.centre) + "," + exact(region.axes[0]) + "," + exact(region.axes[1]) + "," +
                   exact(region.axes[2]) + ")";
        case RegionShape::kBox:
            return "box(" + exact(region.centre) + "," + exact(region.high) + ")";
        case RegionShape::kHalfSpace:
            return "plane(" + exact(region.centre) + "," + exact(region.high) + ")";
        case RegionShape::kMesh:
            return "mesh(\"" + region.dataset + "\")";
        case RegionShape::kMask:
            return "mask(\"" + region.dataset + "\"," + exact(region.threshold) + ")";
    }
    return {};
}

}  // namespace radiata::model
