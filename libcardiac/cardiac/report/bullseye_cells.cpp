#include <cardiac/report/bullseye_cells.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace cardiac {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string point_text(DrawPoint p) {
  return coordinate(p.x) + " " + coordinate(p.y);
}

std::string arc_to(const BullseyeDisc& disc, double r, bool clockwise, double to_deg) {
  const std::string radius = coordinate(disc.radius * r);
  return " A" + radius + " " + radius + " 0 0 " + (clockwise ? "1 " : "0 ") + point_text(disc.at(r, to_deg));
}

}  // namespace

DrawPoint BullseyeCell::centre() const {
  const double span = (to_deg - from_deg) * kDegree;
  const double radius = inner > 0 ? (inner + outer) / 2 : 4 * outer * std::sin(span / 2) / (3 * span);
  const double angle = (from_deg + to_deg) / 2 * kDegree;
  if (inner == 0 && to_deg - from_deg == 360) return {0, 0};
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

bool BullseyeCell::holds(double radius, double angle_deg) const {
  if (radius < inner || radius > outer) return false;
  const double turn = std::fmod(std::fmod(angle_deg - from_deg, 360) + 360, 360);
  return turn <= to_deg - from_deg;
}

BullseyeCell bullseye_cell(int segment) {
  if (segment < 1 || segment > 17) throw std::out_of_range("a bull's-eye has the segments 1 to 17");
  constexpr double kCap = 0.22, kApical = 0.48, kMid = 0.74;
  if (segment == 17) return {0, kCap, 0, 360};
  if (segment >= 13) {
    const double from = 45 + 90.0 * (segment - 13);
    return {kCap, kApical, from, from + 90};
  }
  const double from = 60 + 60.0 * ((segment - 1) % 6);
  return segment <= 6 ? BullseyeCell{kMid, 1, from, from + 60} : BullseyeCell{kApical, kMid, from, from + 60};
}

BullseyeCell right_wall_cell(int segment) {
  if (segment < 18 || segment > 29) throw std::out_of_range("the right free wall has the segments 18 to 29");
  constexpr double kApex = 0.26, kApical = 0.51, kMid = 0.76;
  if (segment == 29) return {0, kApex, 90, 270};
  if (segment >= 26) {
    const double from = 90 + 60.0 * (segment - 26);
    return {kApex, kApical, from, from + 60};
  }
  const double from = 90 + 45.0 * ((segment - 18) % 4);
  return segment <= 21 ? BullseyeCell{kMid, 1, from, from + 45}
                       : BullseyeCell{kApical, kMid, from, from + 45};
}

BullseyeCells left_cells() {
  BullseyeCells cells;
  for (int s = 1; s <= 17; ++s) cells[s] = bullseye_cell(s);
  return cells;
}

BullseyeCells right_cells() {
  BullseyeCells cells;
  for (int s = 18; s <= 29; ++s) cells[s] = right_wall_cell(s);
  return cells;
}

DrawPoint BullseyeDisc::at(double r, double angle_deg) const {
  return at({r * std::cos(angle_deg * kDegree), r * std::sin(angle_deg * kDegree)});
}

DrawPoint BullseyeDisc::at(DrawPoint in_unit_disc) const {
  return {centre.x + radius * in_unit_disc.x, centre.y - radius * in_unit_disc.y};
}

std::string cell_path(const BullseyeDisc& disc, const BullseyeCell& cell) {
  // Half way first: an arc of a whole turn, or of half of one, has no side of its own.
  const double half = (cell.from_deg + cell.to_deg) / 2;
  std::string d = "M" + point_text(disc.at(cell.outer, cell.from_deg)) +
                  arc_to(disc, cell.outer, false, half) + arc_to(disc, cell.outer, false, cell.to_deg);
  if (cell.inner > 0)
    d += " L" + point_text(disc.at(cell.inner, cell.to_deg)) + arc_to(disc, cell.inner, true, half) +
         arc_to(disc, cell.inner, true, cell.from_deg);
  return d + " Z";
}

std::string outline_path(const BullseyeDisc& disc, const BullseyeCells& cells,
                         const std::vector<int>& segments) {
  const auto within = [&](double r, double angle_deg) {
    return std::ranges::any_of(segments, [&](int s) {
      const auto cell = cells.find(s);
      return cell != cells.end() && cell->second.holds(r, angle_deg);
    });
  };
  // Borders of the rings meet at multiples of this angle only.
  constexpr double kPiece = 15, kBeside = 1e-3;
  std::string d;
  for (const int s : segments) {
    const auto found = cells.find(s);
    if (found == cells.end()) continue;
    const BullseyeCell& cell = found->second;
    for (double from = cell.from_deg; from < cell.to_deg - kBeside; from += kPiece) {
      for (const auto& [r, other] :
           {std::pair{cell.inner, cell.inner - kBeside}, {cell.outer, cell.outer + kBeside}})
        if (r > 0 && !within(other, from + kPiece / 2))
          d += " M" + point_text(disc.at(r, from)) + arc_to(disc, r, false, from + kPiece);
    }
    if (cell.to_deg - cell.from_deg == 360) continue;
    const double middle = (cell.inner + cell.outer) / 2;
    for (const auto& [side, other] :
         {std::pair{cell.from_deg, cell.from_deg - kBeside}, {cell.to_deg, cell.to_deg + kBeside}})
      if (!within(middle, other))
        d += " M" + point_text(disc.at(cell.inner, side)) + " L" + point_text(disc.at(cell.outer, side));
  }
  return d.empty() ? d : d.substr(1);
}

}  // namespace cardiac
