#pragma once

#include <filesystem>

#include <cardiac/report/run_info.hpp>

namespace cardiac {

/// Reads the result folder of a run back: summary.json, strain.csv, affine.csv, global_strain.csv, cavity.csv
/// and, where it is there, circulation.csv, as written by write_tables; numbers carry 9 significant digits,
/// empty ones are NaN. Throws InputError where folder or file is missing, and with file, line and column (or
/// file and key) where one is malformed or the tables do not belong together.
StoredResult read_result(const std::filesystem::path& folder);

}  // namespace cardiac
