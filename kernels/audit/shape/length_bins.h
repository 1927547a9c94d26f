// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The median of many lengths.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace mw::audit {

/// Counts lengths in 512 bins an octave, so that parts may be counted apart, in any order.
/// Memory: 4 KiB an octave that has lengths.
class LengthBins {
 public:
  /// REQUIRES: length >= 0, or infinite.
  void add(double length);
  void add(const LengthBins& other);
  /// Returns the middle of the bin of the lower median, which is within 0.1 % of it; 0 if empty.
  [[nodiscard]] double median() const;

 private:
  static constexpr int kBinsAnOctave = 512;

  /// The lengths from half a power of two on, or those that are zero or infinite.
  struct Octave {
    int power = 0;
    std::array<std::uint64_t, kBinsAnOctave> bins{};
  };

  /// Where an octave is.
  struct Place {
    int power = std::numeric_limits<int>::max();
    std::uint32_t octave = 0;
  };

  /// Adds a length that is no normal number.
  void add_other(double length);
  [[nodiscard]] Octave& octave_of(int power) {
    const Place& place = places_[static_cast<std::uint32_t>(power) % places_.size()];
    return place.power == power ? octaves_[place.octave] : find_octave(power);
  }
  [[nodiscard]] Octave& find_octave(int power);

  std::vector<Octave> octaves_;    ///< those that have lengths, ascending
  std::array<Place, 8> places_{};  ///< by the low bits of the power: most lengths are alike
  std::uint64_t count_ = 0;
};

}  // namespace mw::audit
