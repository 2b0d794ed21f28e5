#include "cardiac/anatomy/anatomy.hpp"

#include <algorithm>
#include <utility>

#include <cardiac/anatomy/idealised.hpp>

namespace cardiac {
namespace {

std::optional<int> right_label(const polyaffine::TetMesh& mesh) {
  const auto& found = mesh.boundary_labels();
  if (std::find(found.begin(), found.end(), kRvEndocardium) == found.end()) return {};
  return kRvEndocardium;
}

}  // namespace

Anatomy make_anatomy(polyaffine::TetMesh mesh, const AnatomyOptions& options, FibreFunction fibres) {
  Anatomy out;
  out.mesh = std::move(mesh);
  out.labels.rv_endo = right_label(out.mesh);
  out.fibres = std::move(fibres);
  out.coordinates = std::make_shared<VentricularCoordinates>(out.mesh, out.labels, options);
  out.segment = segment_tets(out.mesh, *out.coordinates);
  out.options = options;
  return out;
}

}  // namespace cardiac
