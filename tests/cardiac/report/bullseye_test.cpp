#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <regex>

#include <cardiac/report/bullseye.hpp>
#include <cardiac/report/wall_picture.hpp>
#include <polyaffine/core/types.hpp>

namespace cardiac {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

long count(const std::string& text, const std::string& what) {
  long n = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(Bullseye, LiesAsInTheStandard) {
  const auto direction = [](int segment) {
    const DrawPoint c = bullseye_cell(segment).centre();
    return std::atan2(c.y, c.x) * 180 / polyaffine::kPi;
  };
  for (const int anterior : {1, 7, 13}) EXPECT_NEAR(direction(anterior), 90, 1e-9);
  for (const int inferior : {4, 10, 15}) EXPECT_NEAR(direction(inferior), -90, 1e-9);
  EXPECT_NEAR(direction(2), 150, 1e-9);             // anteroseptal: upper left
  EXPECT_NEAR(direction(3), -150, 1e-9);            // inferoseptal: lower left
  EXPECT_NEAR(std::abs(direction(14)), 180, 1e-9);  // septal: left
  EXPECT_NEAR(direction(16), 0, 1e-9);              // lateral: right
  EXPECT_NEAR(direction(5), -30, 1e-9);
  EXPECT_NEAR(direction(6), 30, 1e-9);
  EXPECT_EQ(bullseye_cell(17).centre().x, 0);
  EXPECT_EQ(bullseye_cell(17).centre().y, 0);
  EXPECT_THROW(bullseye_cell(18), std::out_of_range);
}

TEST(Bullseye, CellsTileTheDisc) {
  double area = 0;
  for (int segment = 1; segment <= 17; ++segment) {
    const BullseyeCell c = bullseye_cell(segment);
    area += (c.outer * c.outer - c.inner * c.inner) * (c.to_deg - c.from_deg) / 360;
  }
  EXPECT_NEAR(area, 1, 1e-14);  // of the unit disc, in round-off
}

TEST(Bullseye, ShowsEverySegmentWithItsValueAndGreyWhereThereIsNone) {
  Bullseye bullseye{"Peak", "", Quantity::longitudinal, {}, {}};
  for (int s = 1; s <= 16; ++s) bullseye.values[s] = 0.5 - s;
  bullseye.values[4] = std::numeric_limits<double>::quiet_NaN();
  const std::string svg = bullseye_svg(bullseye);
  for (int i = 1; i <= 17; ++i) EXPECT_THAT(svg, HasSubstr(">" + std::to_string(i) + "</text>"));
  EXPECT_THAT(svg, HasSubstr(">−15.5</text>"));
  EXPECT_EQ(count(svg, "fill=\"#e0e0e0\""), 2);
  EXPECT_EQ(count(svg, ">–</text>"), 2);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(RightWall, LiesBesideTheSeptumAndTilesHalfADisc) {
  double area = 0;
  for (int segment = 18; segment <= 29; ++segment) {
    const BullseyeCell c = right_wall_cell(segment);
    area += (c.outer * c.outer - c.inner * c.inner) * (c.to_deg - c.from_deg) / 360;
    EXPECT_LT(c.centre().x, 0) << segment;  // left of the septum, as the septum is left in the bull's-eye
    EXPECT_TRUE(c.holds(std::hypot(c.centre().x, c.centre().y),
                        std::atan2(c.centre().y, c.centre().x) * 180 / std::numbers::pi));
  }
  EXPECT_NEAR(area, 0.5, 1e-14);
  // Anterior to inferior in each row, the base outside.
  for (const auto& [first, last] : {std::pair{18, 21}, {22, 25}, {26, 28}}) {
    for (int s = first; s < last; ++s)
      EXPECT_GT(right_wall_cell(s).centre().y, right_wall_cell(s + 1).centre().y + 0.05);
    EXPECT_NEAR(right_wall_cell(first).centre().y, -right_wall_cell(last).centre().y, 1e-12);
  }
  EXPECT_EQ(right_wall_cell(21).outer, 1);
  EXPECT_EQ(right_wall_cell(29).inner, 0);
  EXPECT_THROW(right_wall_cell(17), std::out_of_range);
  EXPECT_THROW(right_wall_cell(30), std::out_of_range);
}

// Boxes of texts, from the letters' widths in Helvetica Bold (Adobe's metrics) and the height of a capital.
struct Box {
  double left, right, top, bottom;
};

double text_advance(const std::string& content, double size) {
  double em = 0;
  for (size_t i = 0; i < content.size(); ++i) {
    const auto c = static_cast<unsigned char>(content[i]);
    if ((c & 0xC0) == 0x80) continue;
    em += c >= 0x80 ? 0.584 : c == '.' ? 0.278 : 0.556;  // minus or dash, point, digit
  }
  return em * size;
}

double attribute(const std::string& element, const std::string& name) {
  std::smatch found;
  EXPECT_TRUE(std::regex_search(element, found, std::regex(" " + name + "=\"([-0-9.e]+)\""))) << element;
  return std::stod(found[1]);
}

// Every point of the border of the box keeps `clear` from the border of the cell.
bool within(const Box& box, const BullseyeCell& cell, const BullseyeDisc& disc, double clear) {
  constexpr int kSteps = 20;
  for (int i = 0; i <= kSteps; ++i) {
    const double s = static_cast<double>(i) / kSteps;
    const double x = box.left + s * (box.right - box.left), y = box.top + s * (box.bottom - box.top);
    for (const DrawPoint p : {DrawPoint{x, box.top}, {x, box.bottom}, {box.left, y}, {box.right, y}}) {
      const double dx = p.x - disc.centre.x, dy = disc.centre.y - p.y, r = std::hypot(dx, dy);
      if (r > disc.radius * cell.outer - clear) return false;
      if (cell.inner > 0 && r < disc.radius * cell.inner + clear) return false;
      if (cell.to_deg - cell.from_deg == 360) continue;
      // Distances to the straight sides, positive inside; cells span at most half a turn.
      const double a = cell.from_deg * std::numbers::pi / 180, b = cell.to_deg * std::numbers::pi / 180;
      if (std::cos(a) * dy - std::sin(a) * dx < clear || std::sin(b) * dx - std::cos(b) * dy < clear)
        return false;
    }
  }
  return true;
}

void expect_labels_inside(const std::string& svg, const BullseyeCells& cells, const BullseyeDisc& disc) {
  constexpr double kClear = 2;  // half of the border's stroke, and as much again
  const std::regex text("<text [^>]*text-anchor=\"middle\"[^>]*>([−–0-9.]+)</text>");
  int labels = 0;
  for (std::sregex_iterator i(svg.begin(), svg.end(), text), end; i != end; ++i) {
    const std::string element = i->str();
    const double x = attribute(element, "x"), y = attribute(element, "y"),
                 size = attribute(element, "font-size");
    const double dx = x - disc.centre.x, dy = disc.centre.y - y;
    const auto cell = std::ranges::find_if(cells, [&](const auto& entry) {
      return entry.second.holds(std::hypot(dx, dy) / disc.radius,
                                std::atan2(dy, dx) * 180 / std::numbers::pi);
    });
    if (cell == cells.end()) continue;  // of the colour bar
    ++labels;
    EXPECT_GE(size, 7) << element;
    const double half = text_advance((*i)[1], size) / 2;
    EXPECT_TRUE(within({x - half, x + half, y - 0.718 * size, y}, cell->second, disc, kClear))
        << element << " in segment " << cell->first;
  }
  EXPECT_EQ(labels, 2 * cells.size());
}

Bullseye of_values(const BullseyeCells& cells, const std::vector<double>& values) {
  Bullseye bullseye{"Test", "", Quantity::longitudinal, {}, {}};
  size_t i = 0;
  for (const auto& [segment, cell] : cells) bullseye.values[segment] = values[i++ % values.size()];
  return bullseye;
}

TEST(Bullseye, LabelsKeepClearOfTheBordersOfTheirCells) {
  for (const std::vector<double>& values :
       {std::vector<double>{-15.5}, {-100.4}, {123.4}, {0}, {-1234.5}, {NAN}, {-29.9, 30.1, 4.2}}) {
    SCOPED_TRACE(values.front());
    expect_labels_inside(bullseye_svg(of_values(left_cells(), values)), left_cells(), bullseye_disc());
    expect_labels_inside(right_wall_svg(of_values(right_cells(), values)), right_cells(), right_wall_disc());
  }
}

TEST(Bullseye, OrdinaryLabelsAreLarge) {
  // Printed on 80 mm of paper, 520 units wide, 14 units are 6 points.
  const std::regex value("<text [^>]*>−15.5</text>");
  for (const std::string& svg :
       {bullseye_svg(of_values(left_cells(), {-15.5})), right_wall_svg(of_values(right_cells(), {-15.5}))})
    for (std::sregex_iterator i(svg.begin(), svg.end(), value), end; i != end; ++i)
      EXPECT_GE(attribute(i->str(), "font-size"), 14) << i->str();
}

TEST(Bullseye, OneScaleWhateverTheValuesAre) {
  const auto fill_of = [](double value, double others) {
    Bullseye bullseye = of_values(left_cells(), {others});
    bullseye.values[5] = value;
    const std::string svg = bullseye_svg(bullseye);
    std::smatch found;
    EXPECT_TRUE(std::regex_search(svg, found, std::regex("fill=\"(#[0-9a-f]{6})\"[^>]*><title>Segment 5:")));
    return found[1].str();
  };
  EXPECT_EQ(fill_of(-12, -3), fill_of(-12, -28));
  EXPECT_NE(fill_of(-12, -3), fill_of(-14, -3));
  // The same colour as in the picture of the wall.
  EXPECT_EQ(fill_of(-12, -3), scale_of(Quantity::circumferential).range.colour(-12).hex());
  EXPECT_THAT(bullseye_svg(of_values(left_cells(), {1})),
              HasSubstr("colours from −30 to 30 % in every report"));
}

TEST(Bullseye, MarksValuesBeyondTheScale) {
  const std::string low = "below the lowest value", high = "above the highest value";
  const auto marks = [&](const std::vector<double>& values) {
    const std::string svg = bullseye_svg(of_values(left_cells(), values));
    return std::pair{count(svg, low) - 1, count(svg, high) - 1};  // but those of the bar
  };
  EXPECT_EQ(marks({-30, 30}), (std::pair<long, long>{0, 0}));
  EXPECT_EQ(marks({-30.1}), (std::pair<long, long>{17, 0}));
  EXPECT_EQ(marks({31, 31, 31, 31, 31, 31, 31, 31, 31, 31, 31, 31, 31, 31, 31, 31, -31}),
            (std::pair<long, long>{1, 16}));
}

TEST(Bullseye, MarksBeyondTheScaleStayInTheirCells) {
  const std::regex mark(
      "<path d=\"M(\\S+) (\\S+) L(\\S+) (\\S+) L(\\S+) (\\S+) Z\"[^>]*><title>(below|above) the");
  const auto check = [&](const std::string& svg, const BullseyeCells& cells, const BullseyeDisc& disc) {
    size_t inside = 0;
    for (std::sregex_iterator i(svg.begin(), svg.end(), mark), end; i != end; ++i) {
      std::array<double, 3> x{}, y{};
      for (int k = 0; k < 3; ++k) x[k] = std::stod((*i)[2 * k + 1]), y[k] = std::stod((*i)[2 * k + 2]);
      const Box box{*std::ranges::min_element(x), *std::ranges::max_element(x), *std::ranges::min_element(y),
                    *std::ranges::max_element(y)};
      inside +=
          std::ranges::any_of(cells, [&](const auto& entry) { return within(box, entry.second, disc, 2); });
    }
    EXPECT_EQ(inside, cells.size());
  };
  for (const double value : {-45.6, 45.6}) {
    check(bullseye_svg(of_values(left_cells(), {value})), left_cells(), bullseye_disc());
    check(right_wall_svg(of_values(right_cells(), {value})), right_cells(), right_wall_disc());
  }
}

// Length of a path of arcs about the disc's centre and straight lines, in radii.
double length_of(const std::string& d, const BullseyeDisc& disc) {
  const std::regex piece("M(\\S+) (\\S+) (?:A(\\S+) \\S+ 0 0 0 (\\S+) (\\S+)|L(\\S+) (\\S+))");
  double length = 0;
  for (std::sregex_iterator i(d.begin(), d.end(), piece), end; i != end; ++i) {
    const bool arc = (*i)[3].matched;
    const double dx = std::stod((*i)[arc ? 4 : 6]) - std::stod((*i)[1]);
    const double dy = std::stod((*i)[arc ? 5 : 7]) - std::stod((*i)[2]);
    const double chord = std::hypot(dx, dy);
    if (!arc) {
      length += chord / disc.radius;
      continue;
    }
    const double r = std::stod((*i)[3]);
    length += 2 * r * std::asin(chord / 2 / r) / disc.radius;
  }
  return length;
}

TEST(Regions, OutlineIsTheBorderOfTheirUnion) {
  const BullseyeDisc disc{{0, 0}, 1000};
  const auto outline = [&](const std::vector<int>& segments) {
    return length_of(outline_path(disc, left_cells(), segments), disc);
  };
  const double pi = std::numbers::pi;
  // Coordinates have two decimals: 1e-5 of the radius a piece, some tens of pieces.
  constexpr double kDigits = 1e-3;
  EXPECT_NEAR(outline({1}), 0.26 * 2 + pi / 3 * (1 + 0.74), kDigits);
  EXPECT_NEAR(outline({1, 2}), 0.26 * 2 + 2 * pi / 3 * (1 + 0.74), kDigits);
  EXPECT_NEAR(outline({1, 7}), 0.52 * 2 + pi / 3 * (1 + 0.48), kDigits);
  EXPECT_NEAR(outline({1, 7, 13}), 0.78 * 2 + pi / 3 + pi / 2 * 0.22 + pi / 6 * 0.48, kDigits);
  EXPECT_NEAR(outline({17}), 2 * pi * 0.22, kDigits);
  std::vector<int> all;
  for (int s = 1; s <= 17; ++s) all.push_back(s);
  EXPECT_NEAR(outline(all), 2 * pi, kDigits);
  EXPECT_EQ(outline_path(disc, left_cells(), {18, 99}), "");
}

TEST(Regions, AreOutlinedLetteredAndNamed) {
  Bullseye bullseye = of_values(left_cells(), {-12});
  bullseye.regions = {{"anterior <infarct>", {1, 2, 7}}, {"late", {5}}, {"right only", {22}}};
  const std::string left = bullseye_svg(bullseye);
  EXPECT_THAT(left, HasSubstr("<title>anterior &lt;infarct&gt;</title>"));  // of the outline
  EXPECT_THAT(left, HasSubstr(">anterior &lt;infarct&gt;: segments 1, 2, 7</text>"));
  EXPECT_THAT(left, HasSubstr(">late: segment 5</text>"));
  EXPECT_EQ(count(left, ">A</text>"), 2);  // on the disc and before the name
  EXPECT_EQ(count(left, ">B</text>"), 2);
  EXPECT_THAT(left, Not(HasSubstr("right only")));
  const std::string right = right_wall_svg(bullseye);
  EXPECT_EQ(count(right, ">C</text>"), 2);
  EXPECT_THAT(right, HasSubstr(">right only: segment 22</text>"));
  EXPECT_THAT(right, Not(HasSubstr("late:")));
}

TEST(Regions, LongNamesAreCutToTheWidthOfThePicture) {
  Bullseye bullseye = of_values(left_cells(), {-12});
  bullseye.regions = {{std::string(300, 'x'), {1}}, {"é" + std::string(200, 'y'), {2}}};
  EXPECT_THAT(bullseye_svg(bullseye), HasSubstr("xx…</text>"));
  EXPECT_THAT(bullseye_svg(bullseye), HasSubstr(">éyy"));
}

TEST(WallPicture, HasTheScaleOfItsQuantity) {
  WallPicture picture{"Wall", Quantity::circumferential, {}, {}, {{1, 0, 0}, {0, 0, 1}, "a", "b"}, {}};
  picture.panels.push_back({"end systole", "", polyaffine::Points::Random(3, 4), {3.0}});
  EXPECT_THAT(wall_picture_svg(picture), HasSubstr("colours from −30 to 30 % in every report"));
}

}  // namespace
}  // namespace cardiac
