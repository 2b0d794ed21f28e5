#include "run_files.hpp"

#include <cardiac/model/vertex_displacement.hpp>
#include <cardiac/run/key_states.hpp>
#include <cardiac/strain/tet_gauge.hpp>
#include <polyaffine/core/error.hpp>

#ifdef CARDIAC_WITH_VTK
#include <polyaffine/vtk/write.hpp>
#endif

namespace cardiac::app {

using polyaffine::Matrix;
using polyaffine::Points;

#ifdef CARDIAC_WITH_VTK
namespace {

std::string frame_name(std::size_t k) {
  const std::string number = std::to_string(k);
  return "heart_" + std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number + ".vtu";
}

}  // namespace

bool writes_mesh_series() {
  return true;
}

void write_mesh_series(const Ventricle& ventricle, const Protocol& protocol, const HeartPath& path,
                       const BeatResult& result, const std::filesystem::path& out) {
  const Anatomy& anatomy = *ventricle.anatomy;
  const auto map = vertex_displacement(ventricle);
  const Eigen::Index tets = anatomy.mesh.num_tets();
  const HeartState ed = key_states(path, protocol).ed;
  const TetGauge gauge(anatomy.mesh, *anatomy.coordinates, anatomy.mesh.points() + map.apply(ed.c));
  Points fibres;
  if (protocol.fibres) fibres = tet_fibres(anatomy, *protocol.fibres);
  const std::vector<std::string> lcr{"longitudinal", "circumferential", "radial"};
  polyaffine::WriteFields constant, fields;
  constant.integer_cell_fields["segment"] = anatomy.segment;
  fields.single = {"strain_lcr", "segment_strain_lcr", "fibre"};
  fields.components = {{"strain_lcr", lcr}, {"segment_strain_lcr", lcr}};
  for (const SegmentInfo& segment : result.segments) constant.texts["segment_name"].push_back(segment.name);
  if (ventricle.contraction)
    constant.point_fields["activation_ms"] = ventricle.contraction->vertex_delay_ms.transpose();
  const polyaffine::VtuSeries series(anatomy.mesh, constant);
  std::vector<double> times;
  std::vector<std::filesystem::path> files;
  for (std::size_t k = 0; k < path.outputs.size(); ++k) {
    const Points u = map.apply(path.outputs[k].c);
    fields.point_fields["displacement_mm"] = u;
    fields.points = anatomy.mesh.points() + u;
    Matrix strain(3, tets);
    for (Eigen::Index t = 0; t < tets; ++t) {
      const SegmentStrain& s = result.instants[k].strain[anatomy.segment[t] - 1];
      strain.col(t) << s.longitudinal, s.circumferential, s.radial;
    }
    fields.cell_fields["segment_strain_lcr"] = strain;
    fields.cell_fields["strain_lcr"] = gauge.strain(fields.points);
    if (protocol.fibres) fields.cell_fields["fibre"] = gauge.turned(fibres, fields.points);
    files.push_back(out / frame_name(k));
    times.push_back(path.outputs[k].time_ms);
    fields.values["time_ms"] = times.back();
    series.write(files.back(), fields);
  }
  polyaffine::write_pvd(out / "heart.pvd", times, files);
}
#else
bool writes_mesh_series() {
  return false;
}

void write_mesh_series(const Ventricle&, const Protocol&, const HeartPath&, const BeatResult&,
                       const std::filesystem::path&) {
  throw polyaffine::InputError(
      "output.mesh_series: this build writes no .vtu files (VTK is off); set it to false");
}
#endif

}  // namespace cardiac::app
