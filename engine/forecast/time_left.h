// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How long a run will take, from how long it has taken so far.
#pragma once

#include <cstddef>
#include <vector>

namespace mw::engine {

/// The seconds left of work in several parts, one after the other.  How much work each part is
/// need only be right up to one factor, which is what is measured; from one part to the next that
/// factor may change, and the next part's own speed soon replaces that of those before, as that of
/// the first replaces a guess: a stall in the first window says nothing of the others.
/// A pure function of what it is told, times included.
class TimeLeft {
 public:
  /// work: of each part, in any unit, none negative.  guess: seconds a unit, positive.
  TimeLeft(std::vector<double> work, double guess);

  /// The next part begins, `now` seconds from any moment on; skipped: what of it was done before.
  void begin(double now, double skipped);
  /// So much of it has been done since the last call.
  void done(double now, double work);
  [[nodiscard]] double seconds() const;

 private:
  struct Pace {
    double seconds = 0;
    double work = 0;
  };

  [[nodiscard]] double work_left() const;

  std::vector<double> work_;  ///< that is left, of each part
  std::size_t next_ = 0;      ///< part to begin
  double begun_ = 0;
  double size_ = 0;  ///< work of the part without what was skipped
  Pace before_;      ///< of all parts that are over, and one unit of work as guessed
  Pace part_;
};

}  // namespace mw::engine
