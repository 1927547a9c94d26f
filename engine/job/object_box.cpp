// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/job/object_box.h"

#include "engine/store/journal/workdir.h"
#include "io/file/errors.h"

namespace mw::engine {

void check_object_box(const io::VolumeInfo& volume, const MeshJob& job) {
  const std::filesystem::path& folder = job.run.keep.folder;
  if (!job.ends_around_object || folder.empty()) return;
  const std::string different = place_differences(folder, volume);
  if (different.empty()) return;
  io::fail_usage(folder.string(), ": was kept of another box: the one that --object finds ",
                 "is no longer the same (", different,
                 "); delete the folder and begin it by --keep; with --labels and a wider "
                 "--crop instead of --object, the box stays from edit to edit");
}

}  // namespace mw::engine
