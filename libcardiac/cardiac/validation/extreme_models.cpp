#include <cardiac/validation/extreme_checks.hpp>

namespace cardiac {
namespace {

const char* const kSameMesh = "full order on the same mesh";

void nodes(ExtremeChecks& checks, const ExtremeMesh& mesh, const ExtremeOutcome& full) {
  struct Layout {
    std::string name, rings;
    double percent;
  };
  const std::vector<Layout> layouts{{"5", "[4]", 15},
                                    {"17", "[4, 6, 6]", 8},
                                    {"29", "[6, 8, 14]", 8},
                                    {"120", "[12, 16, 20, 24, 24, 23]", 8}};
  for (const char* preset : {"fast", "accurate"})
    for (const Layout& layout : layouts) {
      if (checks.quick() && layout.name == "120" && std::string(preset) == "accurate") continue;
      const auto outcome =
          checks.run("models/nodes_" + layout.name + "_" + preset, mesh, kExtremePassive,
                     {"reduction.ring_nodes=" + layout.rings, std::string("reduction.preset=") + preset});
      checks.expect_inflation_of(outcome, full, layout.percent, kSameMesh);
    }
  checks.expect_refusal(checks.run("models/nodes_1", mesh, kExtremePassive, {"reduction.ring_nodes=[]"}),
                        "expected at least one ring");
  const auto near =
      checks.run("models/coincident_nodes", mesh, kExtremePassive,
                 {"reduction.ring_nodes=[6, 6, 6]", "reduction.ring_positions=[0.5, 0.5001, 0.8]"});
  checks.expect_or_stop(near, "inflation", "1", near.inflation(),
                        {full.inflation(), 0.85 * full.inflation(), 1.15 * full.inflation(), kSameMesh},
                        "expected control nodes apart from each other");
  const auto tiny = checks.run("models/regions_of_two_tets", checks.wall(), kExtremePassive,
                               {"reduction.ring_nodes=[12, 20, 24, 20]"});
  checks.expect(tiny, "tets_of_the_smallest_region", "1", tiny.smallest_region_tets, {2, 1, 2, "the scene"});
  checks.expect_inflation_of(
      tiny, checks.run("models/regions_of_two_tets", checks.wall(), kExtremePassive, full_order({})), 20,
      kSameMesh);
}

void weights(ExtremeChecks& checks, const ExtremeMesh& mesh, const ExtremeOutcome& full) {
  // Of the inflation of full order, about as far again as is reached (96, 96, 49 %): a slope of 20 makes
  // steps of the weights, which bend the wall at the borders of regions and are too stiff.
  struct Slope {
    std::string slope;
    double low, high;
  };
  for (const auto& [slope, low, high] :
       {Slope{"0.5", 0.92, 1.08}, Slope{"2.25", 0.91, 1.09}, Slope{"20", 0.4, 0.6}}) {
    if (checks.quick() && slope == "2.25") continue;
    const auto outcome = checks.run("models/sigmoid_" + slope, mesh, kExtremePassive,
                                    {"reduction.weights=sigmoid", "reduction.sigmoid_slope=" + slope});
    const double expected = full.inflation();
    checks.expect(outcome, "inflation", "1", outcome.inflation(),
                  {expected, low * expected, high * expected, kSameMesh});
  }
}

}  // namespace

void extreme_models(ExtremeChecks& checks) {
  const ExtremeMesh mesh = extreme_mesh({12, 24, 2});
  const auto full = checks.run("models/full_order", mesh, kExtremePassive, full_order({}));
  nodes(checks, mesh, full);
  weights(checks, mesh, full);
  checks.expect_refusal(checks.run("models/more_nodes_than_tets", extreme_mesh({3, 6, 1}), kExtremePassive,
                                   {"reduction.ring_nodes=[24, 24, 24, 24, 24, 24]"}),
                        "no tet lies in the region");
}

}  // namespace cardiac
