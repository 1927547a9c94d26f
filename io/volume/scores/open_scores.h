// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens files of probabilities or signed distances as a volume of labels.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "io/volume/open_options.h"

namespace mw::io {

/// Opens one file, or several: "A,B,C", whose components follow each other.  Where each file has
/// one component, labels have the names of the files, else those that the first file tells.
/// open() opens one file as OpenOptions say.  options.crop is ignored.
/// ERRORS: mw::Error(kInput) naming the file that lies elsewhere than the first, or whose format
/// has no numbers; kUsage for options of masks.
[[nodiscard]] std::unique_ptr<LabelVolume> open_scores(
    const std::filesystem::path& path, const OpenOptions& options,
    const std::function<std::unique_ptr<LabelVolume>(const std::filesystem::path&,
                                                     const OpenOptions&)>& open);

}  // namespace mw::io
