// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is behind the handles of mwmesh_c.h.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/mwmesh_c.h"
#include "io/mesh/mesh_data.h"
#include "io/volume/label_volume.h"

struct mw_error {
  mw_status kind = MW_OK;
  std::string text;
  std::string option;
};

struct mw_volume {
  explicit mw_volume(std::shared_ptr<const mw::io::LabelVolume> labels_in);

  std::shared_ptr<const mw::io::LabelVolume> labels;
  std::vector<mw_name> names;  ///< those of the labels
};

struct mw_mesh {
  mw::io::MeshData data;  ///< values are ascending by name
  std::string record;     ///< data.record as text
  std::string report;
  std::vector<mw_name> names;  ///< those of data
  // Made when first asked for.
  mutable std::mutex wedges_mutex;
  mutable bool has_wedges = false;
  mutable std::vector<std::uint64_t> wedges;
  mutable std::vector<std::uint64_t> wedge_labels;

  /// Takes record and names from data.
  void settle();
};

namespace mw::api {

/// What errors call a volume that is no file.
inline constexpr const char* kArray = "array";

/// Returns rows whose texts are those of the names, which must stay.
[[nodiscard]] std::vector<mw_name> name_rows(const io::LabelNames& names);
[[nodiscard]] io::LabelNames label_names(const mw_name* names, std::size_t count);

/// Writes the mesh into the sink, from begin to finish, with the values of tets if `values` is
/// true; between batches of rows the sink may end it.
void deliver(const mw_mesh& mesh, io::MeshSink& sink, bool values = true);

}  // namespace mw::api
