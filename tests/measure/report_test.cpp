// What is told of a survey: verdicts on tasks, isolux lines, pictures and their texts.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error_of.h"
#include "measure/html.h"
#include "measure/isolux.h"
#include "measure/survey.h"
#include "measure/view.h"

namespace lw {
namespace {

TEST(Statistics, JudgeATaskOnlyOutsideTheInterval) {
    const auto judged = [](double average, double half_width) {
        Statistics s;
        s.count = 1;
        s.average = {average, half_width};
        s.u0 = {0.7, 0.01};
        return judge(s, find_task("office")).both();
    };
    EXPECT_EQ(judged(520, 10), Verdict::pass);
    EXPECT_EQ(judged(505, 10), Verdict::undecided);
    EXPECT_EQ(judged(495, 10), Verdict::undecided);
    EXPECT_EQ(judged(480, 10), Verdict::fail);
    EXPECT_EQ(judge(Statistics{}, find_task("office")).both(), Verdict::undecided) << "all sensors blocked";
    Reading unlit;
    unlit.lamps.assign(2, ChannelLux(0));
    const Value dark;
    const Statistics outside = statistics_of(std::span(&unlit, 1), std::span(&dark, 1));
    EXPECT_EQ(judge(outside, find_task("office")).both(), Verdict::undecided) << "outside the room";
    EXPECT_NE(test::error_of([] { find_task("nap"); }).find("there are: office"), std::string::npos);
}

TEST(Isolux, LineOfAConeIsACircle) {
    constexpr uint n = 41;
    std::vector<double> values;
    for (uint y = 0; y < n; ++y)
        for (uint x = 0; x < n; ++x) values.push_back(100 - std::hypot(double(x) - 20, double(y) - 20));
    const std::vector<IsoluxSegment> line = isolux_line(values, n, n, 90);
    double around = 0;
    for (const IsoluxSegment& s : line) {
        EXPECT_NEAR(length(s.from - vec2(20.5f)), 10, 0.05);
        around += double(length(s.to - s.from));
    }
    EXPECT_NEAR(around, 2 * double(lw_pi) * 10, 0.2);
}

TEST(Report, TextOfTheSceneIsEscaped) { EXPECT_EQ(escaped("<b>&\"x\""), "&lt;b&gt;&amp;&quot;x&quot;"); }

TEST(Report, APictureOfASunlitRoomShowsItsDimPartsToo) {
    std::vector<double> lux(100, 0.0);  // sees nothing
    for (int i = 0; i < 970; ++i) lux.push_back(10 + 0.1 * i);
    lux.insert(lux.end(), 30, 5000);
    const auto [low, high] = range_of_picture(lux);
    EXPECT_EQ(high, 5000);
    EXPECT_NEAR(low, 11, 0.2);
    EXPECT_EQ(range_of_picture({1e-9, 1, 1}).first, 1e-3);  // three decades
    EXPECT_EQ(range_of_picture({7, 7, 7}), std::pair(3.5, 7.0));
    EXPECT_GT(range_of_picture({0, 0}).second, 0);
}

TEST(Report, LabelsOfIsoluxLinesDoNotHideNumbers) {
    MeasuredSet field;
    field.set.kind = SensorSet::Kind::grid;
    field.set.grid = {vec3(0), vec3(1, 0, 0), vec3(0, 0, 1), 3, 3};
    field.readings.resize(9);
    std::vector<Value> values(9);
    for (Value& value : values) value.lux = 400;
    values[4].lux = 182;
    const std::string drawing = grid_drawing(field, values, {1, 1, {0, 0, 0}}, 0.5f, 100, 400);
    EXPECT_NE(drawing.find(">300</text>"), std::string::npos);
    EXPECT_EQ(drawing.find(">200</text>"), std::string::npos) << "its line runs 0.08 cells around the 182";
}

}  // namespace
}  // namespace lw
