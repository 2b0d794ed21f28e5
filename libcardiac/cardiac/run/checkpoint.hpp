#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <cardiac/run/beat.hpp>

namespace cardiac {

/// The coupled heart between two beats: all that run_beats needs to go on. Every run starts its integrator
/// anew at each beat, so that one which goes on from here takes the same steps.
struct Checkpoint {
  int beats = 0, time_steps = 0, newton_iterations = 0;  ///< so far, and so the rest
  std::vector<double> stroke_volumes_mm3;
  std::vector<CycleBeat> cycle;  ///< what the limit is estimated from
  double min_det_F = 1, max_det_F = 1;
  SolveCost cost;
  polyaffine::Vector y, rate;  ///< of CoupledHeart
};

/// What a checkpoint belongs to: it is of use only to a run of the same model.
struct CheckpointOrigin {
  std::string version;        ///< of the program
  std::string protocol_json;  ///< as resolved
  std::string mesh;           ///< polyaffine::digest of the mesh, and of the fibres that come with it
};

/// The text of checkpoint.json; numbers with all their digits. Of the cost only the calls are kept, no
/// seconds.
std::string checkpoint_text(const Checkpoint& checkpoint, const CheckpointOrigin& origin);

/// Reads checkpoint.json. Throws InputError when the file is damaged, or naming what differs (version, mesh
/// or the first key of the protocol) when it is of another origin. The table output may differ, and so may
/// time.max_beats while it leaves a beat to compute.
Checkpoint read_checkpoint(const std::filesystem::path& file, const CheckpointOrigin& origin);

}  // namespace cardiac
