// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How long a run will take, from how long it has taken so far.
#pragma once

#include <cstddef>
#include <vector>

namespace mw::engine {

/// The seconds left of work in several parts, one after the other.  The amounts of work need only
/// be right up to a factor, the speed, which is measured.  The speed may change from one part to
/// the next: a part's own speed soon replaces that of the parts before, as that of the first part
/// replaces a guess; a stall in the first window says nothing of the others.
/// It is a pure function of the calls, times included.
class TimeLeft {
 public:
  /// work holds the amount of work of each part, in any unit; none is negative.  guess is the
  /// seconds that one unit takes, and is positive.
  TimeLeft(std::vector<double> work, double guess);

  /// Begins the next part `now` seconds after any fixed moment; `skipped` of its work is done.
  void begin(double now, double skipped);
  /// Notes that this much work of the part has been done since the last call.
  void done(double now, double work);
  [[nodiscard]] double seconds() const;

 private:
  struct Pace {
    double seconds = 0;
    double work = 0;
  };

  [[nodiscard]] double work_left() const;

  std::vector<double> work_;  ///< the work left in each part
  std::size_t next_ = 0;      ///< part to begin
  double begun_ = 0;
  double size_ = 0;  ///< work of the part without what was skipped
  Pace before_;      ///< pace of all parts that are over, and of one guessed unit of work
  Pace part_;
};

}  // namespace mw::engine
