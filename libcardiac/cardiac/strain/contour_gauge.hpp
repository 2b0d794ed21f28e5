#pragma once

#include <array>
#include <vector>

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/core/beat_result.hpp>
#include <cardiac/strain/material_sheet.hpp>

namespace cardiac {

/// Strain of a ventricle along contours, as speckle and feature tracking measure it (Voigt et al. 2015, Eur.
/// Heart J. Cardiovasc. Imaging 16:1–11): how much a line of material points is longer or shorter than at end
/// diastole, (L − L₀)/L₀. Lines lie on three sheets of material: the inner surface (endocardial), half depth
/// (mid-wall) and the outer surface (epicardial; of the septum its right side). All are those of the mesh
/// with vertices moved and straight edges.
///
/// - Left ventricle (segments 1–17), longitudinal: the whole contour from the base round the apex and back in
///   three planes through the long axis, 0°, 60° and 120° from anterior (apical views); the mean of the
///   three. Circumferential: the contours in three planes across the long axis, at 1/6, 1/2 and 5/6 of the
///   cavity's length (short-axis views at apical, mid and basal level); the mean of the three.
/// - Right ventricle: its free wall (segments 18–29) only, longitudinal, along its rotational coordinates
///   −½, 0 and ½; the mean of the three. There is no circumferential strain and no twist (NaN).
/// - Thickening: the thickness of the wall is its volume over the mean of its inner and outer area,
///   (A_i + √(A_i A_o) + A_o)/3 (exact for a spherical shell), of the same segments without the apex.
/// - Base excursion: how much closer the endocardial rim of the base (mean of its vertices; of the right
///   ventricle that of the free wall) has come to the apex (the epicardial vertex lowest in the mesh) along
///   the long axis, mm, positive towards the apex. Apex motion: how far that vertex is from where it was, mm.
class ContourGauge {
 public:
  enum class Side { left, right };

  /// `x_ed`: end-diastolic positions of the vertices, mm.
  ContourGauge(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
               const std::vector<int>& segment, const SurfaceLabels& labels, Side side,
               const polyaffine::Points& x_ed);

  /// Fills all that is measured along contours (see GlobalStrain), from the positions x of the vertices.
  void measure(const polyaffine::Points& x, GlobalStrain& out) const;

 private:
  enum Layer { inner, middle, outer };
  using Lines = std::vector<MaterialLine>;

  void add_sheets(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                  const std::vector<int>& segment, const SurfaceLabels& labels);
  void add_lines(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates);
  void add_wall(const polyaffine::TetMesh& mesh, const std::vector<int>& segment);
  void add_rim(const polyaffine::TetMesh& mesh, const std::vector<int>& segment, const SurfaceLabels& labels);
  double thickness(const polyaffine::Points& x) const;
  double height(const polyaffine::Points& x) const;  ///< of the rim above the apex, mm

  Side side_;
  polyaffine::Vec3 axis_;
  std::array<MaterialSheet, 3> sheets_;
  std::array<Lines, 3> longitudinal_, circumferential_;
  MaterialSheet inner_wall_, outer_wall_;  ///< without the apex
  polyaffine::Tets wall_;
  std::vector<int> rim_;
  int apex_ = 0;
  std::array<std::vector<double>, 3> longitudinal_ed_, circumferential_ed_;  ///< lengths of the lines, mm
  double thickness_ed_ = 0, height_ed_ = 0;
  polyaffine::Vec3 apex_ed_ = polyaffine::Vec3::Zero();
};

}  // namespace cardiac
