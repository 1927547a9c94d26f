// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a VTK XML image (.vti) as a volume.
#pragma once

#include "io/file/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

[[nodiscard]] bool has_vtk_xml_magic(std::span<const std::byte> head);

/// The array is the one that options.dataset names, else the Scalars of the cells or of the points,
/// else the only array of integers.  Cells are voxels with Origin at a corner; points are their
/// centres.  Appended raw arrays that are not compressed are read by region where they are, others
/// are unpacked into a temporary file.  Memory: of inline arrays the whole text.
/// ERRORS: mw::Error(kInput) naming file and place; kResource when the disk is full.
[[nodiscard]] std::unique_ptr<LabelVolume> open_vti(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

}  // namespace mw::io
