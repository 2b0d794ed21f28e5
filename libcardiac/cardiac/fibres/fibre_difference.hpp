#pragma once

#include <string>
#include <vector>

#include <cardiac/fibres/file_fibres.hpp>
#include <cardiac/fibres/helix.hpp>

namespace cardiac {

/// Angle between two fibre fields (0 to 90°, signs do not count) over a region of the wall, by volume.
struct AngleDistribution {
  std::string region;  ///< "left free wall", "right free wall", "septum" or, of one ventricle, "wall"
  double volume_mm3 = 0, mean_deg = 0, median_deg = 0, p95_deg = 0;
};

/// The file's fibres beside those of the rule, at the centroid of each tet.
struct FibreComparison {
  std::string description;        ///< of the file's fibres
  polyaffine::Points fibre;       ///< the file's, 3 × tets
  std::vector<double> angle_deg;  ///< to the rule's
};
FibreComparison compare_fibres(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                               const FileFibres& file, const HelixAngles& rule);

/// How an angle of each tet is distributed over the regions of the wall: the right free wall where the
/// transventricular coordinate is above ½, the septum where a way from the left endocardium ends on the right
/// one (RightVentricularCoordinates::septal). Regions without a tet are left out.
std::vector<AngleDistribution> angle_distribution(const polyaffine::TetMesh& mesh,
                                                  const VentricularCoordinates& coordinates,
                                                  const std::vector<double>& angle_deg);

}  // namespace cardiac
