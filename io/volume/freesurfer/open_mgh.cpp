// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a volume of FreeSurfer, and names its labels.
#include "io/volume/freesurfer/open_mgh.h"

#include <filesystem>

#include "io/file/errors.h"
#include "io/names/read_names.h"
#include "io/volume/array_series.h"
#include "io/volume/checks.h"

namespace mw::io {
namespace {

/// Takes the names of the colour table beside the volume, if there is one.
void add_names(const std::string& file, VolumeInfo& info) {
  const auto table = std::filesystem::path(file).parent_path() / kFreeSurferTable;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(table, ignored)) return;
  try {
    info.names = read_names(table);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    info.note = text(error.what(), "; labels of ", file, " have no names");
  }
}

}  // namespace

std::unique_ptr<LabelVolume> open_mgh(std::unique_ptr<ByteSource> source,
                                      const OpenOptions& options) {
  const std::string file = source->name();
  const MghHeader header = parse_mgh_header(read_prefix(*source, kMghHeaderBytes), file);
  VolumeInfo info{.shape = header.shape,
                  .space = placed(file, header.space, options),
                  .type = header.type,
                  .format = "mgh"};
  add_names(file, info);
  if (!header.space.is_sized && !options.spacing && options.frame != FrameChoice::kVoxel) {
    info.note = text(file,
                     ": says not where its voxels lie (goodRASFlag is 0): coronal slices of "
                     "1 mm are assumed, as FreeSurfer does");
  }
  return open_series(std::move(source), std::move(info),
                     {.offset = kMghHeaderBytes, .order = ByteOrder::kBig}, header.frames, options);
}

}  // namespace mw::io
