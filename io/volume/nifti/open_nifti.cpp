// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a NIfTI file as a volume.
#include "io/volume/nifti/open_nifti.h"

#include "io/volume/checks.h"
#include "io/volume/file_space.h"
#include "io/volume/nifti/nifti_header.h"
#include "io/volume/nifti/nifti_names.h"
#include "io/volume/raw_array.h"

namespace mw::io {

std::unique_ptr<LabelVolume> open_nifti(std::unique_ptr<ByteSource> source,
                                        const OpenOptions& options) {
  const std::string& file = source->name();
  const NiftiHeader header = parse_nifti_header(read_prefix(*source, kNiftiHeaderBytes), file);
  VolumeInfo info{.shape = header.shape, .type = header.type, .format = "nifti"};
  info.space = placed(file, header.space, options);
  info.scaled = !header.scaling.is_identity();
  info.names = read_nifti_names(*source, header);
  check_payload(*source, info, header.data_offset);
  return std::make_unique<RawArrayVolume>(
      std::move(source), std::move(info),
      ArrayLayout{.offset = header.data_offset, .order = header.order, .scaling = header.scaling});
}

}  // namespace mw::io
