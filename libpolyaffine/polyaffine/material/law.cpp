#include "polyaffine/material/law.hpp"

#include <algorithm>

namespace polyaffine {

void Law::evaluate(int first, int count, const double* F, PointState state, double* W, double* P,
                   double* A) const {
  for (int start = 0; start < count; start += kLanes) {
    const int lanes = std::min(kLanes, count - start);
    const std::ptrdiff_t offset = start;
    PackResponse r;
    clear(r, A != nullptr);
    const Mat3Pack gathered = gather_matrix(F + 9 * offset, lanes);
    respond({first + start, lanes}, {gathered, state}, A != nullptr, r);
    if (W) scatter_add(W + offset, 1, lanes, r.W);
    if (P) scatter_add_points<9>(P + 9 * offset, lanes, r.P);
    if (!A) continue;
    mirror(r);
    scatter_add_points<81>(A + 81 * offset, lanes, r.A[0]);
  }
}

}  // namespace polyaffine
