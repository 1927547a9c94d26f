// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a VTK XML image as a volume.
#include "io/volume/vti/open_vti.h"

#include <string_view>

#include "io/file/errors.h"
#include "io/file/file_source.h"
#include "io/file/scratch_file.h"
#include "io/volume/checks.h"
#include "io/volume/decode.h"
#include "io/volume/raw_array.h"
#include "io/volume/voxel_type.h"
#include "io/volume/vti/vti_grid.h"
#include "io/vtk_xml/vtk_document.h"

namespace mw::io {
namespace {

VoxelType type_of(pugi::xml_node array) {
  const NumberType type = *parse_number_type(array.attribute("type").as_string());
  return type.is_float ? float_type(type.bytes) : integer_type(type.bytes, type.is_signed);
}

bool is_text(pugi::xml_node array) {
  return std::string_view(array.attribute("format").as_string("ascii")) == "ascii";
}

std::unique_ptr<ByteSource> whole(ScratchFile& scratch, const std::string& name) {
  const std::uint64_t size = scratch.size();
  return std::make_unique<FileSource>(scratch.release(), size, name);
}

/// Numbers of text, in 64 bits each.
std::unique_ptr<ByteSource> unpacked_text(VtkDocument& document, pugi::xml_node array,
                                          VolumeInfo& info) {
  ScratchFile scratch(scratch_folder());
  const auto count = static_cast<std::uint64_t>(info.shape.product());
  const auto store = [&](const auto& numbers) {
    for (const auto number : numbers) {
      std::array<std::byte, sizeof number> bytes{};
      store_little(number, bytes.data());
      scratch.append(bytes);
    }
  };
  if (is_float(info.type)) {
    info.type = VoxelType::kF64;
    store(document.reals(array, count));
  } else {
    info.type = integer_type(8, is_signed(info.type));
    store(document.integers(array, count));
  }
  return whole(scratch, document.file());
}

std::unique_ptr<ByteSource> unpacked_bytes(VtkDocument& document, pugi::xml_node array,
                                           const VolumeInfo& info) {
  ScratchFile scratch(scratch_folder());
  document.visit_bytes(array, payload_bytes(info),
                       [&](std::span<const std::byte> piece) { scratch.append(piece); });
  return whole(scratch, document.file());
}

}  // namespace

bool has_vtk_xml_magic(std::span<const std::byte> head) {
  const std::string_view start(reinterpret_cast<const char*>(head.data()), head.size());
  return start.find("<VTKFile") != std::string_view::npos;
}

std::unique_ptr<LabelVolume> open_vti(std::unique_ptr<ByteSource> source,
                                      const OpenOptions& options) {
  const std::string file = source->name();
  VtkDocument document(*source, {"ImageData", "give a .vti file, an image of voxels"});
  const VtiGrid grid = parse_vti_grid(document.grid(), file);
  const VtiArray array = choose_vti_array(document.grid().child("Piece"), options.dataset, file);
  VolumeInfo info;
  info.shape = vti_shape(grid, array.of_points, file);
  info.type = type_of(array.node);
  info.format = "vti";
  info.space = placed(file, vti_space(grid, array.of_points), options);
  ArrayLayout position{.order = document.order()};
  std::unique_ptr<ByteSource> data;
  if (is_text(array.node)) {
    data = unpacked_text(document, array.node, info);
    position.order = ByteOrder::kLittle;
  } else if (const auto offset = document.plain_bytes(array.node, payload_bytes(info))) {
    position.offset = *offset;
    data = std::move(source);
  } else {
    data = unpacked_bytes(document, array.node, info);
  }
  check_payload(*data, info, position.offset);
  return std::make_unique<RawArrayVolume>(std::move(data), std::move(info), position);
}

}  // namespace mw::io
