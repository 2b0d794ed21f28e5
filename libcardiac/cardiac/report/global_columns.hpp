#pragma once

#include <array>
#include <string>

#include <cardiac/core/beat_result.hpp>

namespace cardiac {

/// One number of the global strain of a ventricle: its column in global_strain.csv and its key in
/// summary.json.
struct GlobalColumn {
  std::string column, key;
  double GlobalStrain::*own = nullptr;
  LayerStrain GlobalStrain::*layers = nullptr;  ///< or, of one of these,
  double LayerStrain::*layer = nullptr;         ///< the strain in a layer

  double value(const GlobalStrain& of) const { return own ? of.*own : of.*layers.*layer; }
  double& value(GlobalStrain& of) const { return own ? of.*own : of.*layers.*layer; }
};

inline const std::array<GlobalColumn, 13> kGlobalStrain{{
    {"mean_longitudinal_percent", "gls_percent", &GlobalStrain::gls_percent},
    {"mean_circumferential_percent", "gcs_percent", &GlobalStrain::gcs_percent},
    {"mean_radial_percent", "grs_percent", &GlobalStrain::grs_percent},
    {"twist_deg", "twist_deg", &GlobalStrain::twist_deg},
    {"endocardial_longitudinal_percent", "endocardial_gls_percent", nullptr, &GlobalStrain::longitudinal,
     &LayerStrain::endocardial_percent},
    {"midwall_longitudinal_percent", "midwall_gls_percent", nullptr, &GlobalStrain::longitudinal,
     &LayerStrain::midwall_percent},
    {"epicardial_longitudinal_percent", "epicardial_gls_percent", nullptr, &GlobalStrain::longitudinal,
     &LayerStrain::epicardial_percent},
    {"endocardial_circumferential_percent", "endocardial_gcs_percent", nullptr,
     &GlobalStrain::circumferential, &LayerStrain::endocardial_percent},
    {"midwall_circumferential_percent", "midwall_gcs_percent", nullptr, &GlobalStrain::circumferential,
     &LayerStrain::midwall_percent},
    {"epicardial_circumferential_percent", "epicardial_gcs_percent", nullptr, &GlobalStrain::circumferential,
     &LayerStrain::epicardial_percent},
    {"wall_thickening_percent", "wall_thickening_percent", &GlobalStrain::wall_thickening_percent},
    {"base_excursion_mm", "base_excursion_mm", &GlobalStrain::base_excursion_mm},
    {"apex_motion_mm", "apex_motion_mm", &GlobalStrain::apex_motion_mm},
}};

}  // namespace cardiac
