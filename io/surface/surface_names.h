// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the parts of a surface are called in files whose names are single words, and in the names of
// files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/surface/surface_sink.h"

namespace mw::io {

/// Returns the name with '_' for what shells, file systems or readers of text take for something
/// else: control characters, blanks and any of " # $ % & ' * / : ; < = > ? \ ` |
/// Letters of other scripts stay.
[[nodiscard]] std::string one_word(std::string_view name);

/// Returns the name as a part of a file's name on any system: it keeps its blanks, is neither
/// hidden nor in another folder, and does not end in a blank or a dot.
[[nodiscard]] std::string file_word(std::string_view name);

/// Names the shells and runs of a surface by one word each.
class SurfaceNames {
 public:
  explicit SurfaceNames(const SurfaceHeader& header);

  /// Returns the word of a label among those of ranks_of(header).
  /// ENSURES: no two labels have the same word.
  [[nodiscard]] const std::string& label(Label rank) const;
  /// Returns "a|b" for the interface of a and b, and "a||outer" or "a||x_min" for facets of a that
  /// are on no interface.  ENSURES: no two interfaces have the same.
  [[nodiscard]] std::string run(const SurfaceRun& run) const;

 private:
  std::vector<Label> ranks_;
  std::vector<std::string> words_;  ///< by place in ranks_
};

/// Returns the words of the labels whose surfaces these are, in the order of shells.
[[nodiscard]] std::vector<std::string> shell_names(const SurfaceHeader& header);

}  // namespace mw::io
