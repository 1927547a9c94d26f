// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads what labels are called from a file (--names), and gives a volume these names.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "io/names/label_names.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// The most bytes of a file of names, unpacked.
inline constexpr std::uint64_t kMaxNamesBytes = 64 << 20;

/// Reads label descriptions of ITK-SNAP and colour tables of FreeSurfer and Slicer
/// (colour_table.h), or values separated by commas, semicolons or tabs (csv_names.h).  The first
/// line that is no comment decides which.  The file may be gzipped.
/// Text that is not in UTF-8 is read as Latin-1, which `note` then says.
/// ERRORS: mw::Error(kInput) naming file and line; also for a file without labels, above
/// kMaxNamesBytes, or not of text.
[[nodiscard]] LabelNames read_names(const std::filesystem::path& path, std::string* note = nullptr);

/// Reads names from text, which errors call `file`.
[[nodiscard]] LabelNames parse_names(std::string_view text, std::string_view file,
                                     std::string* note = nullptr);

/// The volume with these names added to its own; where both name a label, these win.
/// Thread safety: as the volume below.
class NamedVolume : public VolumeView {
 public:
  NamedVolume(std::shared_ptr<const LabelVolume> volume, const LabelNames& names)
      : VolumeView(std::move(volume)), info_(below().info()) {
    info_.names = info_.names.merged_with(names);
  }

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override { below().read(box, out); }

 private:
  VolumeInfo info_;
};

}  // namespace mw::io
