// Marks are readable on any background, stay at their edge, never overlap, and tiny pictures get none.
#include "encode/annotate.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/error.h"

namespace radiata::encode {
namespace {

Picture flat(int width, int height, std::uint8_t value) {
    Picture picture{width, height, {}};
    picture.rgba.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, value);
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
    return picture;
}

struct Changed {
    int count = 0;
    int left = 1 << 20, top = 1 << 20, right = -1, bottom = -1;
    int darkest = 255, lightest = 0;
};

Changed changed(const Picture& picture, std::uint8_t background) {
    Changed result;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const int value = picture.rgba[(static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                            static_cast<std::size_t>(x)) *
                                           4];
            if (value == background) continue;
            ++result.count;
            result.left = std::min(result.left, x);
            result.right = std::max(result.right, x);
            result.top = std::min(result.top, y);
            result.bottom = std::max(result.bottom, y);
            result.darkest = std::min(result.darkest, value);
            result.lightest = std::max(result.lightest, value);
        }
    }
    return result;
}

model::Mark mark(const char* text, float x, float y, model::MarkAlign horizontal, model::MarkAlign vertical) {
    return {text, x, y, horizontal, vertical, 0, 1};
}

TEST(Annotator, HasLightAndDarkOnAnyBackground) {
    Annotator annotator;
    for (const std::uint8_t background : std::initializer_list<std::uint8_t>{0, 128, 255}) {
        Picture picture = flat(320, 240, background);
        const model::Mark one = mark("LA", 0, 0.5F, model::MarkAlign::kStart, model::MarkAlign::kCenter);
        annotator.draw(picture, {&one, 1});
        const Changed area = changed(picture, background);
        EXPECT_GT(area.count, 30);
        if (background != 255) {
            EXPECT_GE(area.lightest, 200);
        }
        if (background != 0) {
            EXPECT_LE(area.darkest, 60);
        }
        EXPECT_LT(area.right, 60);
        EXPECT_GT(area.top, 90);
        EXPECT_LT(area.bottom, 150);
    }
}

TEST(Annotator, ScalesWithThePicture) {
    Annotator annotator;
    const model::Mark one = mark("S", 1, 1, model::MarkAlign::kEnd, model::MarkAlign::kEnd);
    Picture small = flat(960, 540, 128);
    Picture large = flat(1920, 1080, 128);
    annotator.draw(small, {&one, 1});
    annotator.draw(large, {&one, 1});
    const Changed a = changed(small, 128);
    const Changed b = changed(large, 128);
    EXPECT_NEAR(static_cast<double>(b.bottom - b.top) / (a.bottom - a.top), 2.0, 0.4);
    EXPECT_GT(b.left, 1800);
    EXPECT_GT(b.top, 1000);
}

TEST(Annotator, LeavesOutWhatDoesNotFitOrOverlaps) {
    Annotator annotator;
    const std::vector<model::Mark> same = {mark("one", 0, 0, model::MarkAlign::kStart, model::MarkAlign::kStart),
                                           mark("two", 0, 0, model::MarkAlign::kStart, model::MarkAlign::kStart)};
    Picture both = flat(320, 240, 128);
    Picture first = flat(320, 240, 128);
    annotator.draw(both, same);
    annotator.draw(first, {same.data(), 1});
    EXPECT_EQ(both.rgba, first.rgba);

    const model::Mark wide =
        mark("much too long for a picture this small", 0, 0, model::MarkAlign::kStart, model::MarkAlign::kStart);
    Picture narrow = flat(100, 100, 128);
    annotator.draw(narrow, {&wide, 1});
    EXPECT_EQ(changed(narrow, 128).count, 0);
    Picture tiny = flat(47, 47, 128);
    annotator.draw(tiny, {same.data(), 1});
    EXPECT_EQ(changed(tiny, 128).count, 0);
}

TEST(Annotator, BreaksAndMovesLinesOfABlockInSmallPictures) {
    Annotator annotator;
    const model::Mark letter = mark("S", 0.5F, 0, model::MarkAlign::kCenter, model::MarkAlign::kStart);
    model::Mark subset = mark("subset of fibres in 1226 of 1321 pages: beyond the memory for fibres", 0, 0,
                              model::MarkAlign::kStart, model::MarkAlign::kStart);
    subset.line = 1;
    for (const int width : {320, 160, 120}) {
        Picture alone = flat(width, 240, 128), both = flat(width, 240, 128);
        annotator.draw(alone, {&letter, 1});
        const std::vector<model::Mark> marks = {letter, subset};
        annotator.draw(both, marks);
        const Changed first = changed(alone, 128), all = changed(both, 128);
        EXPECT_GT(all.count, 10 * first.count) << width;
        EXPECT_LT(all.left, 8);
        EXPECT_GT(all.bottom, first.bottom + 8) << "below the letter";
        EXPECT_LT(all.bottom, width < 200 ? 120 : 60);
    }
}

TEST(Annotator, NamesAFontThatIsNotThere) {
    try {
        Annotator annotator("/no/such/font.ttf");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("/no/such/font.ttf"), std::string::npos);
    }
}

TEST(Annotator, LegendsStandInTheUpperRightAndHaveTheMapsColours) {
    Annotator annotator;
    const model::ColourBar bar{ColourMap::kViridis, "radius, mm", "0", "1.5"};
    Picture picture = flat(640, 480, 128);
    annotator.drawBars(picture, {&bar, 1});
    const Changed one = changed(picture, 128);
    EXPECT_GT(one.left, 480);
    EXPECT_LT(one.bottom, 200);
    EXPECT_GT(one.bottom - one.top, 160);
    // Along the strip from its top: yellow to purple, through the whole map.
    const auto at = [&](int x, int y) { return picture.rgba.data() + 4 * (y * 640 + x); };
    int top = one.top;
    while (at(630, top)[0] == 128 || at(630, top)[0] != 253) ++top;
    EXPECT_EQ(at(630, top)[1], 231);
    int bottom = one.bottom;
    while (at(630, bottom)[0] != 68) --bottom;
    EXPECT_EQ(at(630, bottom)[2], 84);
    EXPECT_NEAR(bottom - top, 157, 3);
    EXPECT_NEAR(at(630, (top + bottom) / 2)[1], 145, 4);

    const std::vector<model::ColourBar> many(9, bar);
    annotator.drawBars(picture, many);
    EXPECT_GE(changed(picture, 128).left, 320) << "what does not fit into the right half is left out";
    const model::ColourBar long_name{ColourMap::kViridis, std::string(200, 'n'), "0", "1.5"};
    Picture named = flat(640, 480, 128);
    annotator.drawBars(named, {&long_name, 1});
    EXPECT_GT(changed(named, 128).count, 1000) << "a long name is cut, and its legend stays";
    EXPECT_GE(changed(named, 128).left, 315);
    Picture small = flat(159, 480, 128);
    annotator.drawBars(small, {&bar, 1});
    EXPECT_EQ(changed(small, 128).count, 0);
}

}  // namespace
}  // namespace radiata::encode
