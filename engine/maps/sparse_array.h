// An array of 32-bit words of which many are zero: one bit per word, and the words that are not zero.
#pragma once
#include <bit>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "shaders/types.h"

namespace lw {

/// `marks` and `values` are what a file holds. accept() must be called before words are read.
struct SparseArray {
    std::vector<uint> marks;   // one bit per word that is not zero, 32 words an entry, the first in the lowest bit
    std::vector<uint> values;  // the marked words, in order

    SparseArray() = default;
    explicit SparseArray(std::span<const uint> words) : marks((words.size() + 31) / 32, 0) {
        for (size_t i = 0; i < words.size(); ++i)
            if (words[i]) marks[i / 32] |= 1u << (i % 32);
        values.reserve(find_starts());
        for (uint word : words)
            if (word) values.push_back(word);
    }

    /// Prepares reading. Returns false when marks and values are not those of `count` words: a mark lies beyond them,
    /// or the number of values is not that of marks.
    bool accept(uint64_t count) {
        if (marks.size() != (count + 31) / 32 || (count % 32 != 0 && marks.back() >> (count % 32) != 0)) return false;
        return find_starts() == values.size();
    }
    uint operator[](size_t i) const {
        assert(i / 32 < starts_.size());
        const uint mark = marks[i / 32];
        if (((mark >> (i % 32)) & 1u) == 0) return 0;
        return values[starts_[i / 32] + uint64_t(std::popcount(mark & ((1u << (i % 32)) - 1u)))];
    }
    bool empty() const { return marks.empty(); }
    /// For each 32 words their mark and where their values start, as a shader reads them (shaders/lamp_sum.comp).
    std::vector<uvec2> marks_and_starts() const {
        std::vector<uvec2> pairs(marks.size());
        for (size_t i = 0; i < marks.size(); ++i) pairs[i] = uvec2(marks[i], uint(starts_[i]));
        return pairs;
    }
    uint64_t bytes() const {
        return (marks.size() + values.size()) * sizeof(uint) + starts_.size() * sizeof(starts_[0]);
    }

  private:
    /// Returns the number of marked words.
    uint64_t find_starts() {
        uint64_t found = 0;
        starts_.clear();
        starts_.reserve(marks.size());
        for (uint mark : marks) starts_.push_back(found), found += uint64_t(std::popcount(mark));
        return found;
    }
    std::vector<uint64_t> starts_;  // index in `values` of the first word of each entry of `marks`
};

}  // namespace lw
