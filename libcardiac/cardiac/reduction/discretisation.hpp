#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <cardiac/reduction/segment_frames.hpp>
#include <cardiac/scene/scene.hpp>
#include <cardiac/tissue/fibre_axes.hpp>
#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/kinematics/moving_rim.hpp>
#include <polyaffine/linear/linear_system.hpp>
#include <polyaffine/system/pressure_space.hpp>

namespace cardiac {

/// The surface of a cavity: its points, tangents turned so that X_ξ × X_η leaves the cavity, and the centre
/// of its base, mm.
struct CavitySurface {
  std::string name;  ///< "lv", "rv"
  polyaffine::SurfacePoints points;
  polyaffine::Vec3 base_centre = polyaffine::Vec3::Zero();
  std::optional<polyaffine::MovingRim> rim = {};  ///< where the base moves: it closes the cavity
};

/// What holds the base of a heart in its plane as a whole while every point of it slides.
struct BaseRing {
  polyaffine::MovingRim rim;
  polyaffine::Vec3 normal = polyaffine::Vec3::UnitZ();  ///< unit, out of the heart
};

/// Shape functions with their integration points: a full-order or a reduced model of the same wall.
struct Discretisation {
  std::shared_ptr<const polyaffine::Basis> basis;
  std::shared_ptr<const polyaffine::FrameBasis> frame_basis;  ///< the basis, if reduced; null for full order
  FrameLayout layout;                                         ///< of the control frames, if reduced
  std::vector<int> region;                                    ///< frame that owns each tet, if reduced
  std::shared_ptr<const SegmentFrames> frames;  ///< null for full order and with sigmoid weights
  std::shared_ptr<const polyaffine::FrameField>
      pressure_frames;  ///< weights of pressures, a partition of unity up to the base; null for full order
  std::shared_ptr<const polyaffine::Matrix>
      element_pressures;  ///< pressure functions × tets of a nested model; null: see pressure_space
  polyaffine::Matrix pressure_mass;  ///< of these functions over the elements, mm³
  polyaffine::WallPoints points;
  std::vector<CavitySurface> cavities;          ///< that have a load: the left ventricle's first
  polyaffine::SurfacePoints epicardium_points;  ///< empty unless a spring acts there
  polyaffine::SurfacePoints base_points;        ///< the same of the base
  std::optional<BaseRing> ring;                 ///< of a sliding base
  std::vector<char> fixed;                      ///< unknowns held at zero
  polyaffine::HeldDirections held;              ///< functions that slide
  int num_unknowns = 0;                         ///< that are not fixed
  bool sparse = false;

  /// Do blends of frames make it, whose pressures and local volumes are chosen? A nested model has those of
  /// the elements.
  bool blends_frames() const { return frame_basis && !element_pressures; }
};

/// Where the control frames of a scene's reduction sit. Throws InputError as frame_layout.
FrameLayout frame_layout_of(const Anatomy& anatomy, const Scene& scene);

/// The reduced model: control frames of the layout with the functions that the scene's reduction names.
/// Weights are tents in the ventricular coordinates (SegmentFrames), or sigmoids of the geodesic distance to
/// the border of each region (polyaffine::RegionFrames) about the deepest vertex of the region; the latter
/// are clamped by the factor d = s (2 − s), s = (1 − u)/(1 − u_b), from 0 at the base (u = 1) to 1 at the
/// last ring u_b. With sigmoid weights the anatomy must outlive the result. Throws InputError when a region
/// has no interior vertex, the preset is tuned (tuned_discretisation), or as frame_layout.
Discretisation reduced_discretisation(const Anatomy& anatomy, const Scene& scene);
/// Linear or quadratic finite elements on the whole mesh.
Discretisation full_discretisation(const Anatomy& anatomy, const Scene& scene);

/// Rule of a face, told its tet and its corners.
using FaceRule =
    std::function<polyaffine::TriangleRule(int tet, const polyaffine::LagrangeBasis::FaceCorners& corners)>;

/// Throws InputError when the integration points are fewer than a sixth of the unknowns (a point resists six
/// strains, so that nothing would resist some motion), or when a reduced model has more than 12 000 unknowns.
void check_size(const Discretisation& discretisation);

/// The mean normal of the base, unit, out of the heart: the direction that a sliding base is held in.
polyaffine::Vec3 base_normal(const Anatomy& anatomy);

/// Adds the points of the surfaces on which the scene has loads or springs, and the rims of cavities whose
/// base moves.
void add_surface_points(const Anatomy& anatomy, const Scene& scene, const polyaffine::LagrangeBasis& geometry,
                        const FaceRule& rule, Discretisation& discretisation);

/// The pressure space of a discretisation, over the points of its deformation table.
polyaffine::PressureSpace pressure_space(const Discretisation& discretisation,
                                         const polyaffine::FieldTable& table, const Scene& scene);

}  // namespace cardiac
