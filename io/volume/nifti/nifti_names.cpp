// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels between the header of a NIfTI file and its voxels.
#include "io/volume/nifti/nifti_names.h"

#include <algorithm>

#include "io/names/label_table_xml.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kMaxExtensionBytes = 4 << 20;
constexpr int kMaxExtensions = 1000;
/// Of its own length and its code, two int32.
constexpr std::uint64_t kExtensionHead = 8;

/// 0: no extension begins there.
std::uint64_t extension_bytes(const ByteSource& source, std::uint64_t at, std::uint64_t end,
                              ByteOrder order) {
  if (end < at + kExtensionHead) return 0;
  std::array<std::byte, 4> bytes{};
  source.read_at(at, bytes);
  const auto size = load<std::int32_t>(bytes.data(), order);
  if (size <= static_cast<std::int32_t>(kExtensionHead)) return 0;
  return static_cast<std::uint64_t>(size) <= end - at ? static_cast<std::uint64_t>(size) : 0;
}

/// Padded with NUL, most often.
std::string read_text(const ByteSource& source, std::uint64_t at, std::uint64_t size) {
  std::string out(size, '\0');
  source.read_at(at, std::as_writable_bytes(std::span(out)));
  out.resize(std::min(out.find('\0'), out.size()));
  return out;
}

}  // namespace

LabelNames read_nifti_names(const ByteSource& source, const NiftiHeader& header) {
  const std::uint64_t first = header.version == 1 ? 348 : 540;
  const std::uint64_t end = source.size_within(header.data_offset);
  if (end < first + 4) return {};
  std::array<std::byte, 4> flags{};
  source.read_at(first, flags);
  if (flags[0] == std::byte{0}) return {};
  std::uint64_t at = first + 4;
  for (int i = 0; i < kMaxExtensions; ++i) {
    const std::uint64_t size = extension_bytes(source, at, end, header.order);
    if (size == 0) break;
    if (size <= kMaxExtensionBytes) {
      const std::string text = read_text(source, at + kExtensionHead, size - kExtensionHead);
      LabelNames names = parse_label_table(text);
      if (!names.empty()) return names;
    }
    at += size;
  }
  return {};
}

}  // namespace mw::io
