// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What mwmesh surface says of the triangles that it wrote.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/surface/surface_facts.h"

namespace mw::cli {

/// A file of surfaces.
struct WrittenSurface {
  std::string name;  ///< of its label, where it has one alone
  io::SurfaceFacts facts;
  bool of_labels = false;  ///< whether its volume is that of labels
};

class SurfaceSummary {
 public:
  /// `unit` is that of coordinates; empty where it is not known.
  explicit SurfaceSummary(std::string unit) : unit_(std::move(unit)) {}

  void add(WrittenSurface surface);
  /// Notes that readers join what touches of several labels in a file.
  void note_joined() { is_joined_ = true; }
  /// Notes that no labels were chosen, so that a file has the interfaces of all.
  void note_all() { is_of_all_ = true; }
  /// Prints a line for each of the first few surfaces where there are several, and last one about
  /// all: "surface     closed, manifold, 59.10 mL, 312 triangles".
  void print() const;

 private:
  std::string unit_;
  std::vector<WrittenSurface> first_;  ///< those that are listed
  std::size_t count_ = 0;
  std::size_t closed_ = 0;
  std::size_t manifold_ = 0;
  io::SurfaceFacts all_;  ///< sums
  bool of_labels_ = true;
  bool is_joined_ = false;
  bool is_of_all_ = false;
};

}  // namespace mw::cli
