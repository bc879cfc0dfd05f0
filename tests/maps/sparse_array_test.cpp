// Words of which many are zero: what goes in comes out, and marks that do not fit their values are refused.
#include "maps/sparse_array.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace lw {
namespace {

std::vector<uint> some_words(size_t count, float present) {
    Rng rng(1, 1, count);
    std::vector<uint> words;
    for (size_t i = 0; i < count; ++i) words.push_back(rng.next() < present ? uint(i + 1) : 0u);
    return words;
}

TEST(SparseArray, GiveBackWhatTheyWereMadeOf) {
    for (size_t count : {size_t(0), size_t(1), size_t(31), size_t(32), size_t(33), size_t(1000)})
        for (float present : {0.0f, 0.3f, 1.0f}) {
            const std::vector<uint> words = some_words(count, present);
            SparseArray sparse(words);
            for (size_t i = 0; i < count; ++i) ASSERT_EQ(sparse[i], words[i]) << i << " of " << count;
            EXPECT_TRUE(sparse.accept(count));
            for (size_t i = 0; i < count; ++i) ASSERT_EQ(sparse[i], words[i]) << i << " of " << count;
        }
}

TEST(SparseArray, TakeLessThanTheWordsWhereMostAreZero) {
    const std::vector<uint> words = some_words(32000, 0.1f);
    EXPECT_LT(SparseArray(words).bytes(), 4 * words.size() / 5);
}

TEST(SparseArray, ThatDoNotFitAreRefused) {
    const SparseArray good(some_words(33, 0.5f));
    const auto accepted = [&](uint64_t count, const auto& damage) {
        SparseArray words = good;
        damage(words);
        return words.accept(count);
    };
    EXPECT_TRUE(accepted(33, [](SparseArray&) {}));
    EXPECT_FALSE(accepted(32, [](SparseArray&) {}));
    EXPECT_FALSE(accepted(65, [](SparseArray&) {}));
    EXPECT_FALSE(accepted(33, [](SparseArray& w) { w.values.pop_back(); }));
    EXPECT_FALSE(accepted(33, [](SparseArray& w) { w.values.push_back(1); }));
    EXPECT_FALSE(
        accepted(33, [](SparseArray& w) { w.marks.back() |= 2u, w.values.push_back(1); }));  // beyond the words
}

}  // namespace
}  // namespace lw
