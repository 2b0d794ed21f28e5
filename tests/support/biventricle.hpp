#pragma once

#include <memory>

#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/right_ventricle.hpp>
#include <polyaffine/vtk/read.hpp>

namespace cardiac::testing {

inline const SurfaceLabels kBothLabels{kEndocardium, kEpicardium, kBase, kRvEndocardium};

/// The coarse mesh of the idealised biventricle (apex at −z, right ventricle at +x, anterior +y) and its
/// coordinates, computed once a test program.
struct Biventricle {
  polyaffine::TetMesh mesh;
  std::shared_ptr<const VentricularCoordinates> coordinates;

  Biventricle()
      : mesh(polyaffine::read_vtu(PROJECT_DIR "/meshes/healthy_biv_coarse.vtu", 1)),
        coordinates(std::make_shared<VentricularCoordinates>(mesh, kBothLabels, AnatomyOptions{})) {}

  static const Biventricle& get() {
    static const Biventricle both;
    return both;
  }
};

}  // namespace cardiac::testing
