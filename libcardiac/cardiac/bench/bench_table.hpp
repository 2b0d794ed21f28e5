#pragma once

#include <string>
#include <vector>

#include <cardiac/bench/bench.hpp>

namespace cardiac {

/// bench.csv: comment lines (#) that say what was measured and against what, the header row, a row a model.
/// Numbers as number_text; an empty field where one does not exist.
std::string bench_csv(const std::vector<SceneResult>& results);

/// The same as Markdown tables, one a scene, for people; below them, for each coarser quadratic mesh, how
/// many times faster the fastest reduced model of no larger displacement error is, or that there is none.
std::string bench_markdown(const std::vector<SceneResult>& results);

}  // namespace cardiac
