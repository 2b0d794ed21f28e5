#pragma once

#include <cstdint>
#include <string>

#include <cardiac/core/beat_result.hpp>

namespace cardiac {

/// What a finished run's files say about the run beside its result.
struct RunInfo {
  std::string version;
  std::string protocol_json = "{}";  ///< the protocol as resolved, every default filled in
  std::uint64_t seed = 0;
};

struct StoredResult {
  BeatResult result;
  RunInfo info;
};

}  // namespace cardiac
