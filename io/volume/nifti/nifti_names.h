// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels between the header of a NIfTI file and its voxels.
#pragma once

#include "io/file/byte_source.h"
#include "io/names/label_names.h"
#include "io/volume/nifti/nifti_header.h"

namespace mw::io {

/// The first label table (label_table_xml.h) among the header extensions.  Extensions that are
/// damaged, or hold something else, are nothing: the voxels do not need them.
/// Memory: one extension and its XML tree; none above 4 MiB is looked at.
/// ERRORS: mw::Error(kInput) when the file cannot be read.
[[nodiscard]] LabelNames read_nifti_names(const ByteSource& source, const NiftiHeader& header);

}  // namespace mw::io
