#pragma once

#include <string>

#include <cardiac/report/run_info.hpp>

namespace cardiac {

/// The text of summary.json: the run's numbers, plan and warnings, units in the keys, at most 9 significant
/// digits. A value that does not exist or is not finite is null. Without circulation (`has_beat` false) a
/// ventricle has the volume and pressure reached at the end (`volume_mL`, `pressure_mmHg`) and null for the
/// values of a beat. Throws InputError where `info.protocol_json` is not JSON.
std::string summary_text(const BeatResult& result, const RunInfo& info);

}  // namespace cardiac
