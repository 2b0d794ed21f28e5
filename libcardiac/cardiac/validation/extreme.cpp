#include "cardiac/validation/extreme.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <iterator>
#include <thread>

#include <cardiac/validation/extreme_checks.hpp>

namespace cardiac {
namespace {

using Group = void (*)(ExtremeChecks&);
// The longest first; the random protocols, which share the processors among themselves, come after these.
constexpr std::array<Group, 6> kGroups{extreme_loads,  extreme_models, extreme_materials,
                                       extreme_meshes, extreme_beats,  extreme_tolerances};

// Each group on one thread at a time, as many at once as there are processors.
void run_groups(std::vector<ExtremeChecks>& checks) {
  std::atomic<std::size_t> next = 0;
  std::array<std::exception_ptr, kGroups.size()> failed;
  const auto work = [&] {
    for (std::size_t k = next++; k < kGroups.size(); k = next++) try {
        kGroups[k](checks[k]);
      } catch (...) {
        failed[k] = std::current_exception();
      }
  };
  std::vector<std::jthread> workers;
  for (unsigned k = 0; k < std::max(1U, std::thread::hardware_concurrency()); ++k) workers.emplace_back(work);
  workers.clear();
  for (const std::exception_ptr& one : failed)
    if (one) std::rethrow_exception(one);
}

}  // namespace

std::vector<Check> validate_extreme(const ValidationContext& context) {
  std::vector<ExtremeChecks> checks(kGroups.size() + 1, ExtremeChecks(context));
  run_groups(checks);
  extreme_random(checks.back());
  std::vector<Check> out;
  for (const ExtremeChecks& one : checks) std::ranges::copy(one.checks(), std::back_inserter(out));
  return out;
}

}  // namespace cardiac
