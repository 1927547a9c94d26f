// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text header of a MetaImage volume.
#include "io/volume/metaimage/open_metaimage.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <vector>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/volume/checks.h"

namespace mw::io {
namespace {

using FieldMap = std::map<std::string, std::string, std::less<>>;

std::string field_name(std::string_view key) {
  return text("MetaImage field '", key, "'");
}

/// Reads lines of "Key = Value" up to that of ElementDataFile, which is the last; sets bytes to
/// where it ends.
FieldMap split_fields(std::string_view head, std::size_t& bytes, std::string_view file) {
  FieldMap fields;
  for (std::size_t at = 0; at < head.size();) {
    const std::size_t end = std::min(head.find('\n', at), head.size());
    const std::string_view line = head.substr(at, end - at);
    at = std::min(end + 1, head.size());
    const std::size_t mark = line.find_first_of("=:");
    if (mark == std::string_view::npos) {
      if (trimmed(line).empty()) continue;
      fail_input(file, "MetaImage header", text("no field in '", line.substr(0, 40), "'"),
                 "the header is damaged, or the file is of another format");
    }
    const std::string key(trimmed(line.substr(0, mark)));
    fields[key] = std::string(trimmed(line.substr(mark + 1)));
    if (key != "ElementDataFile") continue;
    bytes = at;
    return fields;
  }
  fail_input(file, field_name("ElementDataFile"), "missing",
             "the header is truncated, or the file is of another format");
}

/// Returns the value of the first of these keys that the header has, or null.
const std::string* find_any(const FieldMap& fields, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    const auto found = fields.find(key);
    if (found != fields.end()) return &found->second;
  }
  return nullptr;
}

const std::string& required(const FieldMap& fields, const char* key, std::string_view file) {
  const std::string* value = find_any(fields, {key});
  if (value == nullptr) fail_input(file, field_name(key), "missing", "add it to the header");
  return *value;
}

bool is_true(const std::string* value) {
  return value != nullptr && !value->empty() &&
         (value->front() == 'T' || value->front() == 't' || value->front() == '1');
}

std::int64_t integer(const std::string& value, const char* key, std::string_view file) {
  const auto number = parse_integer(value);
  if (!number) fail_input(file, field_name(key), text("'", value, "' is no whole number"));
  return *number;
}

/// Refuses a file in which one of these fields has another value than the one that is read.
void refuse_others(const FieldMap& fields, std::string_view file) {
  const std::string* kind = find_any(fields, {"ObjectType"});
  if (kind != nullptr && *kind != "Image") {
    fail_input(file, field_name("ObjectType"), text("'", *kind, "' is no image"),
               "give a file of ObjectType = Image");
  }
  const std::string* channels = find_any(fields, {"ElementNumberOfChannels"});
  if (channels != nullptr && *channels != "1") {
    fail_input(file, field_name("ElementNumberOfChannels"),
               text("voxels of ", *channels, " numbers, labels are single ones"),
               "pick one channel");
  }
  const std::string* binary = find_any(fields, {"BinaryData"});
  if (binary != nullptr && !is_true(binary)) {
    fail_input(file, field_name("BinaryData"), "voxels as text are not supported",
               "save with BinaryData = True");
  }
}

/// MET_LONG has 4 bytes in MetaIO, whatever the machine.
VoxelType parse_type(const std::string& value, std::string_view file) {
  static const std::map<std::string, VoxelType, std::less<>> types{
      {"MET_CHAR", VoxelType::kI8},       {"MET_UCHAR", VoxelType::kU8},
      {"MET_SHORT", VoxelType::kI16},     {"MET_USHORT", VoxelType::kU16},
      {"MET_INT", VoxelType::kI32},       {"MET_UINT", VoxelType::kU32},
      {"MET_LONG", VoxelType::kI32},      {"MET_ULONG", VoxelType::kU32},
      {"MET_LONG_LONG", VoxelType::kI64}, {"MET_ULONG_LONG", VoxelType::kU64},
      {"MET_FLOAT", VoxelType::kF32},     {"MET_DOUBLE", VoxelType::kF64}};
  const auto found = types.find(value);
  if (found != types.end()) return found->second;
  fail_input(file, text(field_name("ElementType"), " = ", value), "unsupported",
             "use integers of 8 to 64 bits, or whole numbers in floats");
}

std::size_t parse_rank(const FieldMap& fields, std::string_view file) {
  const std::int64_t rank = integer(required(fields, "NDims", file), "NDims", file);
  if (rank < 2 || rank > 10) {
    fail_input(file, field_name("NDims"), text(rank, " axes; a volume has 3"));
  }
  return static_cast<std::size_t>(rank);
}

Index3 parse_shape(const FieldMap& fields, std::size_t rank, std::string_view file) {
  auto sizes = parse_integers(required(fields, "DimSize", file));
  if (!sizes || sizes->size() != rank) {
    fail_input(file, field_name("DimSize"),
               text("'", required(fields, "DimSize", file), "' is not ", rank, " whole numbers"));
  }
  sizes->resize(std::max<std::size_t>(rank, 3), 1);
  for (std::size_t axis = 3; axis < rank; ++axis) {
    if ((*sizes)[axis] == 1) continue;
    fail_input(file, field_name("DimSize"),
               text("the array has ", rank, " axes, the last of extent ", (*sizes)[axis]),
               "pick one time or channel");
  }
  return checked_shape(file, field_name("DimSize"), {(*sizes)[0], (*sizes)[1], (*sizes)[2]});
}

/// Returns exactly `count` numbers.
std::vector<double> reals(const std::string& value, std::size_t count, const char* key,
                          std::string_view file) {
  auto numbers = parse_reals(value);
  if (!numbers || numbers->size() != count) {
    fail_input(file, field_name(key), text("'", value, "' is not ", count, " numbers"));
  }
  return *numbers;
}

Vector3 parse_spacing(const FieldMap& fields, std::size_t rank, std::string_view file) {
  Vector3 spacing{1, 1, 1};
  const std::string* value = find_any(fields, {"ElementSpacing", "ElementSize"});
  if (value == nullptr) return spacing;
  const auto numbers = reals(*value, rank, "ElementSpacing", file);
  std::copy_n(numbers.begin(), std::min<std::size_t>(rank, 3), spacing.begin());
  return spacing;
}

std::array<Vector3, 3> parse_directions(const FieldMap& fields, std::size_t rank,
                                        std::string_view file) {
  std::array<Vector3, 3> axes = steps_of({1, 1, 1});
  const std::string* value = find_any(fields, {"TransformMatrix", "Rotation", "Orientation"});
  if (value == nullptr) return axes;
  const auto m = reals(*value, rank * rank, "TransformMatrix", file);
  for (std::size_t i = 0; i < std::min<std::size_t>(rank, 3); ++i) {
    for (std::size_t k = 0; k < std::min<std::size_t>(rank, 3); ++k) axes[i][k] = m[i * rank + k];
  }
  return axes;
}

FileSpace parse_space(const FieldMap& fields, std::size_t rank, std::string_view file) {
  FileSpace space{.first = Vector3{0, 0, 0},
                  .frame = WorldFrame::kLps,
                  .steps_field = "MetaImage fields 'ElementSpacing' and 'TransformMatrix'",
                  .first_field = "MetaImage field 'Offset'"};
  space.is_sized = find_any(fields, {"ElementSpacing", "ElementSize"}) != nullptr;
  const Vector3 spacing = parse_spacing(fields, rank, file);
  space.steps = parse_directions(fields, rank, file);
  for (std::size_t i = 0; i < 3; ++i) {
    // A negative spacing turns no axis.  It becomes NaN, which is refused unless it is replaced.
    const double length = spacing[i] > 0 ? spacing[i] : std::nan("");
    for (double& x : space.steps[i]) x *= length;
  }
  if (const std::string* value = find_any(fields, {"Offset", "Position", "Origin"})) {
    const auto numbers = reals(*value, rank, "Offset", file);
    std::copy_n(numbers.begin(), std::min<std::size_t>(rank, 3), space.first->begin());
  }
  if (const std::string* unit = find_any(fields, {"DistanceUnits"})) {
    if (*unit == "mm" || *unit == "um" || *unit == "cm") space.unit = *unit;
  }
  return space;
}

void parse_data_offset(const FieldMap& fields, MetaImageHeader& header, std::string_view file) {
  header.data_file = required(fields, "ElementDataFile", file);
  header.compressed = is_true(find_any(fields, {"CompressedData"}));
  if (const std::string* value = find_any(fields, {"HeaderSize"})) {
    header.header_size = integer(*value, "HeaderSize", file);
    if (header.header_size < (header.compressed ? 0 : -1)) {
      fail_input(file, field_name("HeaderSize"), text(header.header_size, " is not supported"));
    }
  }
  if (const std::string* value = find_any(fields, {"CompressedDataSize"})) {
    const std::int64_t size = integer(*value, "CompressedDataSize", file);
    if (size < 0) fail_input(file, field_name("CompressedDataSize"), text(size, " is negative"));
    // A writer that did not know the size leaves 0.
    if (size > 0) header.packed_bytes = static_cast<std::uint64_t>(size);
  }
}

}  // namespace

bool has_metaimage_magic(std::span<const std::byte> head) {
  const std::string_view start(reinterpret_cast<const char*>(head.data()), head.size());
  return start.starts_with("ObjectType ") || start.starts_with("ObjectType=") ||
         start.starts_with("NDims ") || start.starts_with("NDims=");
}

MetaImageHeader parse_metaimage_header(std::string_view head, std::string_view file) {
  MetaImageHeader header;
  const FieldMap fields = split_fields(head, header.bytes, file);
  refuse_others(fields, file);
  const std::size_t rank = parse_rank(fields, file);
  header.shape = parse_shape(fields, rank, file);
  header.type = parse_type(required(fields, "ElementType", file), file);
  const bool big = is_true(find_any(fields, {"ElementByteOrderMSB", "BinaryDataByteOrderMSB"}));
  header.order = big ? ByteOrder::kBig : ByteOrder::kLittle;
  parse_data_offset(fields, header, file);
  header.space = parse_space(fields, rank, file);
  return header;
}

}  // namespace mw::io
