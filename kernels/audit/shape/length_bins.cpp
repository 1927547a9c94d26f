// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "kernels/audit/shape/length_bins.h"

#include <cmath>

namespace mw::audit {
namespace {

/// The octave of lengths that are infinite; that of zero is its negative.  Both are beyond those of
/// all other doubles, and std::ldexp() gives the length again.
constexpr int kBeyond = 4000;

}  // namespace

void LengthBins::add(double length) {
  int octave = length > 0 ? kBeyond : -kBeyond;
  std::size_t bin = 0;
  if (length > 0 && std::isfinite(length)) {
    const double mantissa = std::frexp(length, &octave);  // from 0.5 to below 1
    bin = static_cast<std::size_t>((2 * mantissa - 1) * kBinsAnOctave);
  }
  ++octaves_[octave][bin];
  ++count_;
}

void LengthBins::add(const LengthBins& other) {
  for (const auto& [octave, bins] : other.octaves_) {
    auto& here = octaves_[octave];
    for (std::size_t i = 0; i < bins.size(); ++i) here[i] += bins[i];
  }
  count_ += other.count_;
}

double LengthBins::median() const {
  std::uint64_t below = 0;
  for (const auto& [octave, bins] : octaves_) {
    for (std::size_t i = 0; i < bins.size(); ++i) {
      below += bins[i];
      if (2 * below < count_) continue;
      const double share = (static_cast<double>(i) + 0.5) / kBinsAnOctave;
      return std::ldexp((1 + share) / 2, octave);
    }
  }
  return 0;
}

}  // namespace mw::audit
