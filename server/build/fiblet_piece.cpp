#include "build/fiblet_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiata {
namespace {

/// Decodes what was chosen, as every decoder will, and measures.
void measure(const FibletTargets& targets, const CodeTables& tables, FibletPiece& piece) {
    const std::uint32_t width = model::kFibletWidths[piece.width_choice];
    const CodeTables::Table& table = tables.table(piece.width_choice, piece.cap);
    const auto note = [&](glm::vec3 point, std::uint32_t i) {
        const float error = glm::length(point - targets.points[i]);
        piece.max_error_mm = std::max(piece.max_error_mm, error);
        piece.sum_error_mm += error;
    };
    glm::vec3 point(0);
    note(point, 0);
    Turn frame = firstFrame(piece.direction);
    for (std::uint32_t i = 1; i <= targets.segments; ++i) {
        if (i > 1) {
            const std::uint32_t code = piece.codes[i - 2];
            frame = frame * (width > 8 ? codeTurn(code, width, tables.codec().cap_ratio[piece.cap]) : table.turns[code]);
        }
        point += (i == targets.segments ? targets.last_length_mm : tables.codec().step_mm) * axisOf(frame);
        note(point, i);
    }
}

FibletPiece begin(const FibletTargets& targets, std::uint32_t width_choice, std::uint32_t cap) {
    FibletPiece piece;
    piece.width_choice = width_choice;
    piece.cap = cap;
    if (targets.segments > 0) piece.direction = packDirection(targets.points[1]);
    return piece;
}

/// A beginning of the fiblet.
struct Node {
    Turn frame;
    glm::vec3 point{0};
    float cost = 0;
};

/// A node and how it goes on.
struct Next {
    float cost = 0;
    std::uint16_t code = 0, node = 0;
};

/// The cheapest continuations, ascending.
class Best {
public:
    explicit Best(std::uint32_t room) : room_(room) {}
    void offer(float cost, std::uint32_t code, std::uint32_t node) {
        if (count_ == room_ && cost >= next_[count_ - 1].cost) return;
        std::uint32_t at = count_ < room_ ? count_++ : count_ - 1;
        for (; at > 0 && next_[at - 1].cost > cost; --at) next_[at] = next_[at - 1];
        next_[at] = {cost, std::uint16_t(code), std::uint16_t(node)};
    }
    std::uint32_t size() const { return count_; }
    const Next& operator[](std::uint32_t i) const { return next_[i]; }
    void clear() { count_ = 0; }

private:
    std::uint32_t room_, count_ = 0;
    std::array<Next, kBeamMax> next_;
};

/// Offers all 16 codes.
void offerAll(const CodeTables& tables, const CodeTables::Table& table, glm::vec3 aim, float scale, float cost,
              std::uint32_t node, Best& best) {
    const float *x = table.x.data(), *y = table.y.data(), *z = table.z.data();
    float costs[16];
    for (int c = 0; c < 16; ++c) {
        const float dx = aim.x - scale * x[c], dy = aim.y - scale * y[c], dz = aim.z - scale * z[c];
        costs[c] = cost + tables.cost(dx * dx + dy * dy + dz * dz);
    }
    for (std::uint32_t c = 0; c < 16; ++c) best.offer(costs[c], c, node);
}

/// Offers the code nearest to the aim and its neighbours on the grid.
void offerNear(const CodeTables& tables, const CodeTables::Table& table, std::uint32_t width, float ratio, glm::vec3 aim,
               float length, float scale, float cost, std::uint32_t node, Best& best) {
    const std::uint32_t half = width / 2;
    const int side = 1 << half;
    const std::uint32_t code = glm::dot(aim, aim) > 0 ? nearestCode(aim, width, ratio) : 0;
    const int u = int(code) & (side - 1), v = int(code >> half);
    for (int b = std::max(v - 1, 0); b <= std::min(v + 1, side - 1); ++b) {
        for (int a = std::max(u - 1, 0); a <= std::min(u + 1, side - 1); ++a) {
            const auto c = std::uint32_t(a | b << half);
            const glm::vec3 step =
                width > 8 ? length * axisOf(codeTurn(c, width, ratio)) : scale * glm::vec3(table.x[c], table.y[c], table.z[c]);
            const glm::vec3 d = aim - step;
            best.offer(cost + tables.cost(glm::dot(d, d)), c, node);
        }
    }
}

}  // namespace

CodeTables::CodeTables(const shader::FibletCodec& codec, float bound_mm)
    : dear_(0.5625F * bound_mm * bound_mm), codec_(codec), tables_(4 * shader::FIBLET_CAPS) {
    for (std::uint32_t choice = 0; choice < 3; ++choice) {
        for (std::uint32_t cap = 0; cap < shader::FIBLET_CAPS; ++cap) {
            Table& table = tables_[choice * shader::FIBLET_CAPS + cap];
            for (std::uint32_t code = 0; code < 1U << model::kFibletWidths[choice]; ++code) {
                table.turns.push_back(codeTurn(code, model::kFibletWidths[choice], codec.cap_ratio[cap]));
                const glm::vec3 step = codec.step_mm * axisOf(table.turns.back());
                table.x.push_back(step.x);
                table.y.push_back(step.y);
                table.z.push_back(step.z);
            }
        }
    }
}

std::uint32_t CodeTables::bestCap(float turn, std::uint32_t width_choice, bool search) const {
    constexpr std::array<float, 4> kSearched{0.81F, 0.89F, 0.94F, 1.0F}, kNearest{0.9F, 0.95F, 1.0F, 1.0F};
    const float wanted = turn * (search ? kSearched : kNearest)[width_choice];
    std::uint32_t best = 0;
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t cap = 0; cap < shader::FIBLET_CAPS; ++cap) {
        const float angle = std::acos(std::clamp(1 - codec_.cap_ratio[cap], -1.0F, 1.0F)),
                    off = std::abs(std::log(angle / std::max(wanted, 1e-4F)));
        if (off < least) best = cap;
        least = std::min(least, off);
    }
    return best;
}

FibletPiece encodeGreedy(const FibletTargets& targets, std::uint32_t width_choice, std::uint32_t cap,
                         const CodeTables& tables) {
    FibletPiece piece = begin(targets, width_choice, cap);
    const std::uint32_t width = model::kFibletWidths[width_choice];
    const float ratio = tables.codec().cap_ratio[cap], step = tables.codec().step_mm;
    Turn frame = firstFrame(piece.direction);
    glm::vec3 point(0);
    for (std::uint32_t i = 1; i <= targets.segments; ++i) {
        if (i > 1) {
            const glm::vec3 aim = intoFrame(frame, targets.points[i] - point);
            const std::uint32_t code = glm::dot(aim, aim) > 0 ? nearestCode(aim, width, ratio) : 0;
            piece.codes[i - 2] = std::uint16_t(code);
            frame = frame * (width > 8 ? codeTurn(code, width, ratio) : tables.table(width_choice, cap).turns[code]);
        }
        point += (i == targets.segments ? targets.last_length_mm : step) * axisOf(frame);
    }
    measure(targets, tables, piece);
    return piece;
}

FibletPiece encodeBeam(const FibletTargets& targets, std::uint32_t width_choice, std::uint32_t cap, const CodeTables& tables,
                       std::uint32_t beam) {
    FibletPiece piece = begin(targets, width_choice, cap);
    if (targets.segments > 1) {
        const std::uint32_t width = model::kFibletWidths[width_choice], room = std::clamp(beam, 1U, kBeamMax);
        const float ratio = tables.codec().cap_ratio[cap], step = tables.codec().step_mm;
        const CodeTables::Table& table = tables.table(width_choice, cap);
        std::array<Node, kBeamMax> nodes, grown;
        std::array<std::array<Next, kBeamMax>, 62> history;
        nodes[0].frame = firstFrame(piece.direction);
        nodes[0].point = (targets.segments == 1 ? targets.last_length_mm : step) * axisOf(nodes[0].frame);
        std::uint32_t count = 1;
        Best best(room);
        for (std::uint32_t i = 2; i <= targets.segments; ++i) {
            const float length = i == targets.segments ? targets.last_length_mm : step, scale = length / step;
            best.clear();
            for (std::uint32_t n = 0; n < count; ++n) {
                const glm::vec3 aim = intoFrame(nodes[n].frame, targets.points[i] - nodes[n].point);
                if (width == 4) {
                    offerAll(tables, table, aim, scale, nodes[n].cost, n, best);
                } else {
                    offerNear(tables, table, width, ratio, aim, length, scale, nodes[n].cost, n, best);
                }
            }
            for (std::uint32_t n = 0; n < best.size(); ++n) {
                const Next& next = history[i - 2][n] = best[n];
                const Turn turn = width > 8 ? codeTurn(next.code, width, ratio) : table.turns[next.code];
                grown[n].frame = nodes[next.node].frame * turn;
                grown[n].point = nodes[next.node].point + length * axisOf(grown[n].frame);
                grown[n].cost = next.cost;
            }
            count = best.size();
            std::copy_n(grown.begin(), count, nodes.begin());
        }
        for (std::uint32_t i = targets.segments, n = 0; i >= 2; --i) {
            piece.codes[i - 2] = history[i - 2][n].code;
            n = history[i - 2][n].node;
        }
    }
    measure(targets, tables, piece);
    return piece;
}

}  // namespace radiata
