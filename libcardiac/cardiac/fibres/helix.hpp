#pragma once

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/tissue/fibre_axes.hpp>

namespace cardiac {

/// Angles of a rule-based fibre field, degrees.
struct HelixAngles {
  double endo_deg = 60, epi_deg = -60;        ///< of the fibre from circumferential towards the base
  double sheet_deg = 0;                       ///< of the sheet from the wall normal, about the fibre
  double rv_endo_deg = 60, rv_epi_deg = -60;  ///< of the fibre in the right free wall
};

/// Columns f, s, n at a point: with α linear in depth from endo to epi, f = cos α e_c + sin α e_l; s is the
/// radial direction turned about f by the sheet angle, n = f × s. The local axes are made orthonormal first
/// (Streeter et al. 1969; Bayer et al. 2012 for the use of Laplace coordinates).
polyaffine::Mat3 helix_axes(const CoordinateSample& at, const HelixAngles& angles);

/// Columns f, s, n at a point of the mesh: helix_axes of the left ventricle in its wall and the septum, those
/// of the right one in its free wall, turned into each other about the insertions by the share of the right
/// ventricle (spherical interpolation between the nearest of the equivalent axes ±f, ±s, ±n; Bayer et al.
/// 2012).
polyaffine::Mat3 wall_fibres(const VentricularCoordinates& coordinates, int tet,
                             const polyaffine::Vec4& barycentric, const HelixAngles& angles);

/// The same at many points of the mesh.
FibreAxes helix_fibres(const VentricularCoordinates& coordinates, const std::vector<int>& tet,
                       const Eigen::Matrix4Xd& barycentric, const HelixAngles& angles);

/// Orthonormal local axes (columns longitudinal, circumferential, radial) at a point, the radial one kept.
polyaffine::Mat3 orthonormal_axes(const CoordinateSample& at);

}  // namespace cardiac
