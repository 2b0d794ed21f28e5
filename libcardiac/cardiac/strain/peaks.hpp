#pragma once

#include <vector>

#include <cardiac/core/beat_result.hpp>

namespace cardiac {

/// Least end-systolic strain that a post-systolic index is told for. With less at end systole the index of
/// any visible peak (0.1) is above 90 % whatever that value is, and the value's sign is less than what
/// tracking of segments resolves: the segment does not move in systole, which the end-systolic strain itself
/// says.
inline constexpr double kLeastEndSystolicStrain = 0.01;

/// One normal strain of one segment over a beat; strains dimensionless, against end diastole.
struct StrainPeak {
  double value = 0;                        ///< peak over the whole beat
  double time_ms = 0;                      ///< when it is reached; the earliest of equal values
  double systolic = 0;                     ///< peak between ED and ES, both included
  double end_systolic = 0;                 ///< at ES, linear between output times
  double post_systolic_index_percent = 0;  ///< 0 without post-systolic deformation, NaN where undefined
};

struct SegmentPeaks {
  StrainPeak longitudinal, circumferential, radial;
};

/// Peaks of the three normal strains of every segment, in the order of the instants' strains.
///
/// The peak of longitudinal and circumferential strain is the most negative value (shortening), of radial
/// strain the most positive (thickening). A segment that never deforms that way by more than 0.001 has its
/// strongest opposite deformation instead, so that lengthening or thinning shows in the sign; below 0.001
/// both ways the larger counts. Post-systolic index = 100 (peak − ES)/peak, 0 unless the peak has the
/// expected sign and comes outside of systole. It compares two deformations of one kind, so it is NaN where
/// peak and ES differ in sign (a segment that is stretched at ES and shortens only later), and for a
/// post-systolic peak after less than kLeastEndSystolicStrain at ES. Systole goes from `ed_time_ms` to
/// `es_time_ms`, over the end of the beat where ES comes first. Times in ms; ES outside the output times
/// takes the nearest one. Non-finite strains are skipped; without any finite one all values are NaN. No
/// instants, no peaks.
///
/// Definitions: Voigt et al. 2015 (Eur. Heart J. Cardiovasc. Imaging 16:1–11); the index Kukulski et al. 2003
/// (J. Am. Coll. Cardiol. 41:810–819).
std::vector<SegmentPeaks> strain_peaks(const std::vector<Instant>& instants, double ed_time_ms,
                                       double es_time_ms);

}  // namespace cardiac
