// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text header of an INRIMAGE-4 file.
#include "io/volume/inr/inr_header.h"

#include <algorithm>
#include <map>
#include <string>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/volume/checks.h"
#include "io/volume/voxel_type.h"

namespace mw::io {
namespace {

constexpr std::string_view kMagic = "#INRIMAGE-4#{";
constexpr std::string_view kEnd = "##}";
constexpr std::size_t kBlockBytes = 256;

using FieldMap = std::map<std::string, std::string, std::less<>>;

std::string field_name(std::string_view key) {
  return text("inr field '", key, "'");
}

/// Length of the header: whole blocks, the last of which ends in "##}".
std::size_t header_bytes(std::string_view head, std::string_view file) {
  for (std::size_t end = kBlockBytes; end <= head.size(); end += kBlockBytes) {
    if (trimmed(head.substr(end - kBlockBytes, kBlockBytes)).ends_with(kEnd)) return end;
  }
  fail_input(file, "inr header", "no block of 256 bytes ends in ##}",
             "the file is truncated or damaged");
}

FieldMap split_fields(std::string_view header) {
  FieldMap fields;
  header.remove_prefix(std::min(header.size(), kMagic.size()));
  while (!header.empty()) {
    const std::size_t end = std::min(header.find('\n'), header.size());
    const std::string_view line = header.substr(0, end);
    header.remove_prefix(std::min(end + 1, header.size()));
    const std::size_t mark = line.find('=');
    if (line.starts_with('#') || mark == std::string_view::npos) continue;
    fields[std::string(trimmed(line.substr(0, mark)))] = trimmed(line.substr(mark + 1));
  }
  return fields;
}

const std::string& required(const FieldMap& fields, std::string_view key, std::string_view file) {
  const auto found = fields.find(key);
  if (found == fields.end()) {
    fail_input(file, field_name(key), "missing", "add it to the header");
  }
  return found->second;
}

std::int64_t integer(const FieldMap& fields, std::string_view key, std::string_view file) {
  const std::string& value = required(fields, key, file);
  const auto number = parse_integer(value);
  if (!number) fail_input(file, field_name(key), text("'", value, "' is no whole number"));
  return *number;
}

/// "unsigned fixed", "signed fixed" or "float", and "16 bits".
VoxelType parse_type(const FieldMap& fields, std::string_view file) {
  const std::string& kind = required(fields, "TYPE", file);
  const auto words = words_of(required(fields, "PIXSIZE", file));
  const std::int64_t bits = words.empty() ? 0 : parse_integer(words[0]).value_or(0);
  const bool sized = bits == 8 || bits == 16 || bits == 32 || bits == 64;
  const int bytes = static_cast<int>(bits / 8);
  if (sized && kind == "unsigned fixed") return integer_type(bytes, false);
  if (sized && kind == "signed fixed") return integer_type(bytes, true);
  if (sized && bytes >= 4 && (kind == "float" || kind == "double")) return float_type(bytes);
  fail_input(file, text("inr fields 'TYPE' = ", kind, ", 'PIXSIZE' = ", fields.at("PIXSIZE")),
             "unsupported", "use fixed of 8 to 64 bits, or whole numbers in floats");
}

ByteOrder parse_order(const FieldMap& fields, VoxelType type, std::string_view file) {
  if (byte_size(type) == 1) return ByteOrder::kLittle;
  const std::string& cpu = required(fields, "CPU", file);
  if (cpu == "pc" || cpu == "decm" || cpu == "alpha") return ByteOrder::kLittle;
  if (cpu == "sun" || cpu == "sgi") return ByteOrder::kBig;
  fail_input(file, field_name("CPU"), text("'", cpu, "' is unknown"), "give pc or sun");
}

void refuse_others(const FieldMap& fields, std::string_view file) {
  if (fields.contains("VDIM") && integer(fields, "VDIM", file) != 1) {
    fail_input(file, field_name("VDIM"),
               text("voxels of ", fields.at("VDIM"), " numbers, labels are single ones"),
               "pick one of them");
  }
  const auto scale = fields.find("SCALE");
  if (scale != fields.end() && scale->second != "2**0") {
    fail_input(file, field_name("SCALE"), text(scale->second, " is not supported"),
               "save with SCALE=2**0");
  }
}

/// Three fields, one an axis.
Vector3 vector_of(const FieldMap& fields, char letter, double otherwise, std::string_view file) {
  Vector3 out{otherwise, otherwise, otherwise};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string key{letter, "XYZ"[i]};
    const auto found = fields.find(key);
    if (found == fields.end()) continue;
    const auto number = parse_real(found->second);
    if (!number) fail_input(file, field_name(key), text("'", found->second, "' is no number"));
    out[i] = *number;
  }
  return out;
}

}  // namespace

InrHeader parse_inr_header(std::string_view head, std::string_view file) {
  if (!head.starts_with(kMagic)) {
    fail_input(file, "inr magic", text("the file does not begin with ", kMagic),
               "it is damaged or of another format");
  }
  InrHeader header{.bytes = header_bytes(head, file)};
  const FieldMap fields = split_fields(head.substr(0, header.bytes));
  refuse_others(fields, file);
  header.shape = checked_shape(file, "inr size",
                               {integer(fields, "XDIM", file), integer(fields, "YDIM", file),
                                integer(fields, "ZDIM", file)});
  header.type = parse_type(fields, file);
  header.order = parse_order(fields, header.type, file);
  header.space.steps = steps_of(vector_of(fields, 'V', 1, file));
  header.space.steps_field = "inr fields 'VX', 'VY', 'VZ'";
  header.space.first = vector_of(fields, 'T', 0, file);
  header.space.first_field = "inr fields 'TX', 'TY', 'TZ'";
  header.space.first_is_centre = false;
  return header;
}

}  // namespace mw::io
