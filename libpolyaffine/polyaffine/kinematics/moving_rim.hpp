#pragma once

#include <vector>

#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/kinematics/lagrange.hpp>

namespace polyaffine {

/// A weighted mean of material points, o = Σ w_i x_i with Σ w_i = 1: it moves with them.
struct MeanPoint {
  std::vector<int> tet;
  Eigen::Matrix4Xd barycentric;
  Vector weights;                ///< dimensionless
  Points X;                      ///< at rest, mm
  Vec3 position = Vec3::Zero();  ///< o at rest, mm
};

/// Points of the open edges of a surface, with position, tangent along the edge and the weights ds of its
/// parameter s.
struct EdgePoints {
  std::vector<int> tet;
  Eigen::Matrix4Xd barycentric;
  Vector weights;
  Points X, X_s;  ///< mm
};

/// The rims of an open surface and the point o from which they are closed: the surface together with the
/// cones from its rims to o is a closed one that moves with the body.
struct MovingRim {
  MeanPoint centre;
  EdgePoints edges;
};

/// The edges that belong to one face only of the faces with one of the labels (two Gauss points each: exact
/// for quadratic edges), run in the sense of the faces, which point out of the body; the centre is the mean
/// by length of the straight edges of the loop whose centre is nearest to `near` (mm). Throws InputError as
/// rim_loops and when the surface is closed.
MovingRim moving_rim(const LagrangeBasis& elements, const TetMesh& mesh, const std::vector<int>& labels,
                     const Vec3& near);

/// M = [x − o, x_ξ, x_η] on a surface with a moving origin o. With SignedVolume of factor 1/3 it integrates
/// to the volume between the surface and the cones from its rims to o; with any rule a rigid motion does not
/// change it. Every point sees the functions of the origin: meant for few of them.
FieldTable surface_table(const Basis& basis, const SurfacePoints& points, const MeanPoint& origin);

/// M = [o − O, r − o, r_s] on the rims r, the weights being ½ ds: with SignedVolume of factor 1/3 it
/// integrates to the part ⅓ ∫ (x − O)·n da of the cones from the rims to o. Added to that of the surface it
/// closes it: the sum ⅓ ∮ (x − O)·n da is the volume by the divergence theorem, whatever O.
FieldTable lid_table(const Basis& basis, const MovingRim& rim, const Vec3& origin);

/// M = [ū, θ n, 0] at one point of weight 1: the mean displacement ū = Σ w_i u_i of material points and their
/// mean small rotation about an axis n through their mean, θ = Σ w_i n·(r_i × u_i) / Σ w_i |r_i × n|² with
/// r_i = X_i − o. For what holds a body as a whole.
FieldTable mean_motion_table(const Basis& basis, const MeanPoint& points, const Vec3& axis);

/// The points of two tables, those of `more` behind, over the same functions.
FieldTable joined(FieldTable table, const FieldTable& more);

}  // namespace polyaffine
