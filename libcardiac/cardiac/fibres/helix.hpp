#pragma once

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/tissue/fibre_axes.hpp>

namespace cardiac {

/// Angles of a rule-based fibre field, degrees.
struct HelixAngles {
  double endo_deg = 60, epi_deg = -60;  ///< of the fibre from circumferential towards the base
  double sheet_deg = 0;                 ///< of the sheet from the wall normal, about the fibre
};

/// Columns f, s, n at a point: with α linear in depth from endo to epi, f = cos α e_c + sin α e_l; s is the
/// radial direction turned about f by the sheet angle, n = f × s. The local axes are made orthonormal first
/// (Streeter et al. 1969; Bayer et al. 2012 for the use of Laplace coordinates).
polyaffine::Mat3 helix_axes(const CoordinateSample& at, const HelixAngles& angles);

/// The same at many points of the mesh.
FibreAxes helix_fibres(const VentricularCoordinates& coordinates, const std::vector<int>& tet,
                       const Eigen::Matrix4Xd& barycentric, const HelixAngles& angles);

/// Orthonormal local axes (columns longitudinal, circumferential, radial) at a point, the radial one kept.
polyaffine::Mat3 orthonormal_axes(const CoordinateSample& at);

}  // namespace cardiac
