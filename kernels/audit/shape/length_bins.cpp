// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "kernels/audit/shape/length_bins.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mw::audit {
namespace {

/// The power of lengths that are infinite; that of zero is its negative.  Both are beyond those of
/// all other doubles, and std::ldexp() gives the length again.
constexpr int kBeyond = 4000;

}  // namespace

LengthBins::Octave& LengthBins::find_octave(int power) {
  auto octave = std::lower_bound(octaves_.begin(), octaves_.end(), power,
                                 [](const Octave& o, int wanted) { return o.power < wanted; });
  if (octave == octaves_.end() || octave->power != power) {
    octave = octaves_.insert(octave, {.power = power});
    places_ = {};
  }
  places_[static_cast<std::uint32_t>(power) % places_.size()] = {
      power, static_cast<std::uint32_t>(octave - octaves_.begin())};
  return *octave;
}

void LengthBins::add(double length) {
  // The sign, the exponent and nine bits of the mantissa: the power of two and the bin.
  const auto bits = std::bit_cast<std::uint64_t>(length) >> 43U;
  constexpr std::uint64_t kLeastNormal = kBinsAnOctave, kInfinite = std::uint64_t{2047} << 9U;
  if (bits - kLeastNormal >= kInfinite - kLeastNormal) return add_other(length);
  ++octave_of(static_cast<int>(bits / kBinsAnOctave) - 1022).bins[bits % kBinsAnOctave];
  ++count_;
}

void LengthBins::add_other(double length) {
  int power = length > 0 ? kBeyond : -kBeyond;
  std::size_t bin = 0;
  if (length > 0 && std::isfinite(length)) {
    const double mantissa = std::frexp(length, &power);  // from 0.5 to below 1
    bin = static_cast<std::size_t>((2 * mantissa - 1) * kBinsAnOctave);
  }
  ++octave_of(power).bins[bin];
  ++count_;
}

void LengthBins::add(const LengthBins& other) {
  for (const Octave& octave : other.octaves_) {
    auto& here = octave_of(octave.power).bins;
    for (std::size_t i = 0; i < here.size(); ++i) here[i] += octave.bins[i];
  }
  count_ += other.count_;
}

double LengthBins::median() const {
  std::uint64_t below = 0;
  for (const Octave& octave : octaves_) {
    for (std::size_t i = 0; i < octave.bins.size(); ++i) {
      below += octave.bins[i];
      if (2 * below < count_) continue;
      const double share = (static_cast<double>(i) + 0.5) / kBinsAnOctave;
      return std::ldexp((1 + share) / 2, octave.power);
    }
  }
  return 0;
}

}  // namespace mw::audit
