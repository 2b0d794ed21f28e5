#pragma once

#include <array>

#include <polyaffine/core/types.hpp>

namespace cardiac {

using polyaffine::Points;
using polyaffine::Vec3;

/// Labels of the surfaces of a ventricle mesh; the last one only with a right ventricle.
inline constexpr int kEndocardium = 1;
inline constexpr int kEpicardium = 2;
inline constexpr int kBase = 3;
inline constexpr int kRvEndocardium = 4;

/// Regions of the wall of two ventricles.
inline constexpr int kLvWall = 1;
inline constexpr int kRvWall = 2;
inline constexpr int kSeptum = 3;

/// A left ventricle between two half ellipsoids of revolution about z, centred at the origin, cut by the base
/// plane z = base_z_mm; the apex points to −z. Semi-axes in mm.
struct TruncatedEllipsoid {
  double endo_short_mm;
  double endo_long_mm;
  double epi_short_mm;
  double epi_long_mm;
  double base_z_mm;
};

/// The ventricle of Land et al. 2015 (Proc. R. Soc. A 471, 20150641), problems 2 and 3.
TruncatedEllipsoid land_ellipsoid();

/// An unloaded human left ventricle: cavity about 75 mL, wall 10 mm, 81 mm from apex to base inside.
TruncatedEllipsoid human_lv();

/// The shape with a larger or smaller cavity and a thicker or thinner wall: endocardial semi-axes and base
/// plane times `cavity`, epicardial semi-axes beyond them by `wall` times what they were. Factors of 1 leave
/// every number as it is. Throws InputError as check_shape does.
TruncatedEllipsoid scaled(const TruncatedEllipsoid& shape, double cavity, double wall);

/// Throws InputError when an axis is not positive and finite, the wall has no thickness, or the base plane
/// does not cut both ellipsoids.
void check_shape(const TruncatedEllipsoid& shape);

/// An edge length that leaves about two tets through the wall: 0.52 of its thickness at the equator, mm.
double default_mesh_size_mm(const TruncatedEllipsoid& shape);

/// First-order distance of x from the ellipsoid with these semi-axes about the origin (mm), negative inside.
double ellipsoid_function(const Vec3& semi_axes_mm, const Vec3& x);

/// Negative in the wall, zero on its surface, positive outside; in mm near the surface.
double wall_function(const TruncatedEllipsoid& shape, const Vec3& x);

/// The closed edges where endocardium and epicardium meet the base plane, n points each, first one repeated
/// at the end.
std::array<Points, 2> rims(const TruncatedEllipsoid& shape, int n);

/// V = π a² (z − z³/(3c²)) between −c and the base plane, mm³; a, c: endocardial semi-axes.
double exact_cavity_volume(const TruncatedEllipsoid& shape);
/// Volume between the two ellipsoids below the base plane, mm³.
double exact_wall_volume(const TruncatedEllipsoid& shape);

/// Nearest point of an ellipsoid of revolution about z; semi-axes short_mm (x, y) and long_mm (z).
Vec3 project_to_ellipsoid(double short_mm, double long_mm, const Vec3& x);

/// Nearest point of the labelled surface: endocardium, epicardium (full ellipsoids) or base plane.
Vec3 project_to_surface(const TruncatedEllipsoid& shape, int label, const Vec3& x);

/// Nearest point of the rim (label kEndocardium or kEpicardium) on the base plane.
Vec3 project_to_rim(const TruncatedEllipsoid& shape, int label, const Vec3& x);

/// Nearest point of the wall's surface, on the rims for points within tolerance_mm of two surfaces.
Vec3 project_to_wall_surface(const TruncatedEllipsoid& shape, double tolerance_mm, const Vec3& x);

/// The surface that three boundary points lie on, within tolerance_mm; throws ComputationError when they
/// share none.
int surface_label(const TruncatedEllipsoid& shape, double tolerance_mm, const std::array<Vec3, 3>& triangle);

}  // namespace cardiac
