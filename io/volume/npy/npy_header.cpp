// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The header of a .npy file.
#include "io/volume/npy/open_npy.h"

#include <charconv>
#include <cstring>
#include <vector>

#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/decode.h"

namespace mw::io {
namespace {

constexpr std::string_view kMagic{"\x93NUMPY", 6};
constexpr std::string_view kSpaces = " \t\r\n";
constexpr std::size_t kMaxDictBytes = 1 << 20;
constexpr std::int64_t kMaxComponents = 65535;
/// NumPy has no arrays with more axes.
constexpr std::size_t kMaxAxes = 64;

/// Returns the text behind `'key':`.
std::string_view value_of(std::string_view dict, std::string_view key, std::string_view file) {
  for (const char* quote : {"'", "\""}) {
    const std::string quoted = text(quote, key, quote);
    std::size_t at = dict.find(quoted);
    if (at == std::string_view::npos) continue;
    at = dict.find_first_not_of(kSpaces, at + quoted.size());
    if (at == std::string_view::npos || dict[at] != ':') break;
    at = dict.find_first_not_of(kSpaces, at + 1);
    if (at != std::string_view::npos) return dict.substr(at);
  }
  fail_input(file, text("npy header '", key, "'"), "missing", "save the array with numpy.save");
}

std::string_view parse_quoted(std::string_view value, std::string_view file) {
  const std::size_t end =
      value[0] == '\'' || value[0] == '"' ? value.find(value[0], 1) : std::string_view::npos;
  if (end == std::string_view::npos) {
    fail_input(file, "npy header 'descr'", "not a plain type (a record array?)",
               "save one field of integers");
  }
  return value.substr(1, end - 1);
}

void parse_descr(std::string_view descr, NpyHeader& header, std::string_view file) {
  const std::string field = text("npy header 'descr' = '", descr, "'");
  const bool sized = descr.size() == 3 && descr[2] >= '1' && descr[2] <= '8';
  const int bytes = sized ? descr[2] - '0' : 0;
  const char kind = descr.size() > 1 ? descr[1] : '?';
  const bool integer = (kind == 'u' || kind == 'i') && bytes != 0 && (bytes & (bytes - 1)) == 0;
  const bool boolean = kind == 'b' && bytes == 1;
  const bool floating = kind == 'f' && (bytes == 4 || bytes == 8);
  if ((!integer && !boolean && !floating) ||
      std::string_view("<>|=").find(descr[0]) == std::string_view::npos ||
      (descr[0] == '|' && bytes > 1)) {
    fail_input(file, field, "unsupported type",
               "use integers of 8 to 64 bits, or whole numbers in floats of 32 or 64");
  }
  header.type = floating ? float_type(bytes) : integer_type(bytes, kind == 'i');
  header.order = descr[0] == '>' ? ByteOrder::kBig : ByteOrder::kLittle;
  if (descr[0] == '=') header.order = kHostOrder;
}

std::vector<std::int64_t> parse_tuple(std::string_view value, std::string_view file) {
  const std::size_t end = value.find(')');
  const std::string field = text("npy header 'shape' = ", value.substr(0, end), ")");
  if (value[0] != '(' || end == std::string_view::npos) fail_input(file, field, "not a tuple");
  std::vector<std::int64_t> numbers;
  for (std::size_t at = 1; at < end;) {
    at = value.find_first_not_of(" \t\r\n,L", at);
    if (at >= end) break;
    std::int64_t number = 0;
    const auto [stop, verdict] = std::from_chars(value.data() + at, value.data() + end, number);
    if (verdict != std::errc{}) fail_input(file, field, "not integers within 64 bits");
    numbers.push_back(number);
    at = static_cast<std::size_t>(stop - value.data());
  }
  return numbers;
}

[[noreturn]] void fail_axes(std::size_t axes, std::string_view file) {
  fail_input(file, "npy header 'shape'",
             text("the array has ", axes, " axes, a volume has 3 [z, y, x]"),
             "reshape or pick one channel");
}

/// Returns the shape, and finds the components where voxels have scores.
Index3 parse_shape(std::string_view value, NpyHeader& header, VoxelValues values,
                   std::string_view file) {
  std::vector<std::int64_t> axes = parse_tuple(value, file);
  if (axes.size() > kMaxAxes) fail_axes(axes.size(), file);
  if (axes.size() == 2) axes.insert(axes.begin(), 1);
  // The array may be one volume of a series, or one channel.
  while (axes.size() > 3 && axes.front() == 1) axes.erase(axes.begin());
  const std::size_t most = values == VoxelValues::kLabels ? 3 : 4;
  while (axes.size() > most && axes.back() == 1) axes.pop_back();
  if (axes.size() == 4 && axes.front() > 1 && axes.front() <= kMaxComponents) {
    header.components = axes.front();
    axes.erase(axes.begin());
  }
  if (axes.size() != 3) fail_axes(axes.size(), file);
  return checked_shape(file, "npy header 'shape'", {axes[2], axes[1], axes[0]});
}

}  // namespace

bool has_npy_magic(std::span<const std::byte> bytes) {
  return bytes.size() >= kMagic.size() &&
         std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

NpyPrefix parse_npy_prefix(std::span<const std::byte> bytes, std::string_view file) {
  if (!has_npy_magic(bytes)) {
    fail_input(file, "npy magic", "the file does not begin with \\x93NUMPY",
               "it is damaged or of another format");
  }
  if (bytes.size() < 12) {
    fail_input(file, "npy header", text("truncated: the file holds ", bytes.size(), " bytes"));
  }
  const int version = std::to_integer<int>(bytes[6]);
  if (version < 1 || version > 3) {
    fail_input(file, "npy version", text(version, " is unknown"), "save as version 1, 2 or 3");
  }
  NpyPrefix prefix{.dict_offset = version == 1 ? 10U : 12U, .dict_length = 0};
  prefix.dict_length = version == 1 ? load<std::uint16_t>(&bytes[8], ByteOrder::kLittle)
                                    : load<std::uint32_t>(&bytes[8], ByteOrder::kLittle);
  if (prefix.dict_length > kMaxDictBytes) {
    fail_input(file, "npy header length", text(prefix.dict_length, " bytes is not credible"),
               "the header is damaged");
  }
  return prefix;
}

NpyHeader parse_npy_dict(std::string_view dict, VoxelValues values, std::string_view file) {
  NpyHeader header;
  parse_descr(parse_quoted(value_of(dict, "descr", file), file), header, file);
  const std::string_view fortran = value_of(dict, "fortran_order", file);
  header.fortran_order = fortran.starts_with("True");
  if (!header.fortran_order && !fortran.starts_with("False")) {
    fail_input(file, "npy header 'fortran_order'", "neither True nor False");
  }
  header.shape = parse_shape(value_of(dict, "shape", file), header, values, file);
  return header;
}

std::string format_npy_header(const VolumeInfo& info) {
  const int bytes = byte_size(info.type);
  std::string dict = text("{'descr': '", bytes == 1 ? "|" : "<", is_signed(info.type) ? "i" : "u",
                          bytes, "', 'fortran_order': False, 'shape': (", info.shape.z, ", ",
                          info.shape.y, ", ", info.shape.x, "), }");
  dict.resize(kOwnNpyHeaderBytes - 11, ' ');
  dict.push_back('\n');
  std::string header(kMagic);
  header.append(
      {'\1', '\0', static_cast<char>(dict.size() % 256), static_cast<char>(dict.size() / 256)});
  return header + dict;
}

}  // namespace mw::io
