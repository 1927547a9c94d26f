// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an array of an image of VTK, whose numbers are raw, packed or text.
#include "io/volume/vti/open_vti.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/source/file_source.h"
#include "io/volume/raw_array.h"
#include "io/volume/text_voxels.h"

namespace mw::io {
namespace {

using SharedSource = std::shared_ptr<const ByteSource>;

constexpr VtkKind kImage{
    .type = "ImageData", .way_out = "give an image (.vti)", .leaves_contents = true};

/// Bytes of voxels, and the order of those in a number.
struct Voxels {
  SharedSource source;
  ByteOrder order = ByteOrder::kLittle;
};

/// Checks the length that raw data have in front of them, and skips it.
SharedSource raw_voxels(const SharedSource& source, const VtkDocument& document,
                        std::uint64_t begin, std::uint64_t bytes, const ArrayName& name) {
  SourceStream stream(*source, begin);
  if (const std::uint64_t held = announced_bytes(stream, document.encoding(), name);
      held != bytes) {
    fail_input(name.file, text("array '", name.array, "'"),
               text("holds ", held, " bytes, the extent needs ", bytes), "the file is damaged");
  }
  const std::uint64_t first = begin + static_cast<std::uint64_t>(document.encoding().header_bytes);
  return std::make_shared<BytesPart>(source, first, bytes, name.file);
}

SharedSource unpacked_voxels(ByteStream& stream, const VtkDocument& document, std::uint64_t bytes,
                             const ArrayName& name) {
  UnlinkedFile file(scratch_folder());
  std::uint64_t at = 0;
  each_piece(stream, document.encoding(), bytes, name, [&](std::span<const std::byte> piece) {
    file.write_at(at, piece);
    at += piece.size();
  });
  return std::make_shared<FileSource>(file.release(), bytes, name.file);
}

Voxels voxels_of(const SharedSource& source, const VtkDocument& document, const VtiArray& array,
                 const VolumeInfo& info) {
  using Form = VtkContent::Form;
  const ArrayName name{document.file(), array.path};
  const VtkContent content = document.content_of(array.node);
  if (content.form == Form::kText) {
    const std::uint64_t end = std::min(content.end, source->size_within(content.end));
    const std::uint64_t begin = std::min(content.begin, end);
    const BytesPart words(source, begin, end - begin, document.file());
    return {voxels_of_text(words, info.type, static_cast<std::uint64_t>(info.shape.product()),
                           text("array '", array.path, "'")),
            ByteOrder::kLittle};
  }
  const ByteOrder order = document.encoding().order;
  const std::uint64_t bytes = payload_bytes(info);
  if (content.form == Form::kBase64) {
    Base64Stream stream(*source, content.begin, content.end);
    return {unpacked_voxels(stream, document, bytes, name), order};
  }
  if (document.encoding().packing == VtkPacking::kNone) {
    return {raw_voxels(source, document, content.begin, bytes, name), order};
  }
  SourceStream stream(*source, content.begin);
  return {unpacked_voxels(stream, document, bytes, name), order};
}

/// Cells lie between points: there is one less of them along an axis, but one in a plane.
Index3 shape_of(const VtiGrid& grid, const VtiArray& array, const std::string& file) {
  std::array<std::int64_t, 3> extents = grid.points;
  if (array.is_cells) {
    for (std::int64_t& extent : extents) extent = extent > 1 ? extent - 1 : extent;
  }
  return checked_shape(file, "ImageData WholeExtent", extents);
}

}  // namespace

bool has_vti_magic(std::span<const std::byte> head) {
  const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
  return text.find("<VTKFile") != text.npos &&
         (text.find("\"ImageData\"") != text.npos || text.find("'ImageData'") != text.npos);
}

std::unique_ptr<LabelVolume> open_vti(std::unique_ptr<ByteSource> source,
                                      const OpenOptions& options) {
  const SharedSource shared = std::move(source);
  const VtkDocument document(*shared, kImage);
  const VtiGrid grid = parse_vti_grid(document);
  const VtiArray array = choose_vti_array(document, options.dataset);
  FileSpace space = grid.space;
  space.first_is_centre = !array.is_cells;
  VolumeInfo info{.shape = shape_of(grid, array, document.file()),
                  .space = placed(document.file(), space, options),
                  .type = array.type,
                  .format = "vti"};
  Voxels voxels = voxels_of(shared, document, array, info);
  return std::make_unique<RawArrayVolume>(std::move(voxels.source), std::move(info),
                                          ArrayLayout{.order = voxels.order});
}

}  // namespace mw::io
