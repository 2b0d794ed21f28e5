#include "wall_figure.hpp"

#include <Eigen/Geometry>

#include <cardiac/core/units.hpp>
#include <cardiac/model/vertex_displacement.hpp>
#include <cardiac/report/tables.hpp>
#include <cardiac/report/text.hpp>
#include <cardiac/report/wall_picture.hpp>
#include <cardiac/strain/peaks.hpp>

namespace cardiac::app {

Figure wall_figure(const Ventricle& ventricle, const Protocol& protocol, const HeartPath& path,
                   const BeatResult& result) {
  const Anatomy& anatomy = *ventricle.anatomy;
  const VentricularCoordinates& coordinates = *anatomy.coordinates;
  const polyaffine::Vec3& axis = coordinates.axis();
  const polyaffine::Vec3 lateral = coordinates.anterior().cross(axis).normalized();
  const bool beat = result.has_beat || result.has_contraction;
  WallPicture picture{"Circumferential strain of the segments",
                      Quantity::circumferential,
                      cut_wall(anatomy.mesh, coordinates.base_centre(), lateral),
                      anatomy.segment,
                      {lateral + 0.35 * axis, axis, "inferior", "anterior"},
                      {}};
  const auto map = vertex_displacement(ventricle);
  const auto panel = [&](const HeartState& state, const std::string& title) {
    const polyaffine::Points x = anatomy.mesh.points() + map.apply(state.c);
    const std::string note = display_text(state.volumes_mm3[0] / mm3_per_mL, 0) + " mL, " +
                             display_text(state.pressures_kPa[0] / kPa_per_mmHg, 0) + " mmHg";
    return WallPanel{title, note, picture.cut.positions(x), {}};
  };
  const KeyStates key = key_states(path, protocol);
  WallPanel before = panel(key.ed, beat ? "end diastole" : "start");
  WallPanel after = panel(key.es, beat ? "end systole" : "end");
  const auto [ed_ms, es_ms] = cardiac_times(result);
  const std::vector<SegmentPeaks> peaks = strain_peaks(result.instants, ed_ms, es_ms);
  before.values.resize(peaks.size());
  after.values.resize(peaks.size());
  for (std::size_t s = 0; s < peaks.size(); ++s) {
    before.values.at(s) = 0;
    after.values.at(s) = 100 * peaks[s].circumferential.end_systolic;
  }
  picture.panels = {std::move(before), std::move(after)};
  return {"wall.svg", wall_picture_svg(picture)};
}

}  // namespace cardiac::app
