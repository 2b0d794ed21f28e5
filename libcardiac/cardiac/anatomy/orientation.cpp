#include "cardiac/anatomy/orientation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <sstream>

#include <polyaffine/mesh/surface.hpp>

namespace cardiac {
namespace {

// Share of the radius by which an idealised wall, meshed coarsely, may seem to leave the axis.
constexpr double kRound = 0.02;

bool round_about_z(const polyaffine::Points& points, const polyaffine::Triangles& faces) {
  const polyaffine::Vector areas = polyaffine::triangle_areas(points, faces);
  double whole = 0;
  std::array<std::complex<double>, 3> wave{};
  for (Eigen::Index f = 0; f < faces.cols(); ++f) {
    const polyaffine::Vec3 x = points(Eigen::all, faces.col(f)).rowwise().mean();
    const double r = std::hypot(x.x(), x.y()), phi = std::atan2(x.y(), x.x());
    whole += areas[f] * r;
    for (int k = 1; k <= 3; ++k) wave.at(k - 1) += std::polar(areas[f] * r, k * phi);
  }
  return std::ranges::all_of(wave, [&](const auto& w) { return std::abs(w) < kRound * whole; });
}

}  // namespace

bool turned_about_z(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels) {
  return std::ranges::all_of(std::array{labels.endo, labels.epi, labels.base},
                             [&](int label) { return round_about_z(mesh.points(), mesh.surface({label})); });
}

std::vector<std::string> orientation_notes(const VentricularCoordinates& coordinates) {
  std::vector<std::string> out = notes_of(coordinates.long_axis());
  const polyaffine::Vec3& a = coordinates.anterior();
  std::ostringstream text;
  text.precision(3);
  text << "anterior (" << a.x() << ", " << a.y() << ", " << a.z() << "): "
       << (coordinates.right()              ? "by the right ventricle"
           : coordinates.anterior_assumed() ? "taken as +y"
                                            : "as given");
  out.push_back(text.str());
  return out;
}

std::vector<std::string> orientation_warnings(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels,
                                              const VentricularCoordinates& coordinates) {
  std::vector<std::string> out = warnings_of(coordinates.long_axis());
  if (coordinates.anterior_assumed() && !turned_about_z(mesh, labels))
    out.push_back(
        "anterior is taken as +y, which numbers the segments: give anatomy.anterior_direction (--anterior), "
        "anatomy.septum_point (--septum-point) or anatomy.rv_insertion_point (--rv-insertion-point)");
  return out;
}

}  // namespace cardiac
