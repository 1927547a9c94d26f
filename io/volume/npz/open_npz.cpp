// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens an array of a NumPy .npz archive as a volume.
#include "io/volume/npz/open_npz.h"

#include "io/file/errors.h"
#include "io/file/inflater.h"
#include "io/file/part_source.h"
#include "io/volume/checks.h"
#include "io/volume/npy/npy_header.h"
#include "io/volume/npy/open_npy.h"
#include "io/volume/npz/zip_directory.h"

namespace mw::io {
namespace {

constexpr std::string_view kSuffix = ".npy";

/// "a, b, c" for error messages, cut where it gets long.
std::string listed(const std::vector<ZipMember>& arrays) {
  constexpr std::size_t kMaxNames = 20;
  std::string names;
  for (std::size_t i = 0; i < arrays.size() && i < kMaxNames; ++i) {
    const std::string_view name = arrays[i].name;
    names += text(i == 0 ? "" : ", ", name.substr(0, name.size() - kSuffix.size()));
  }
  return arrays.size() > kMaxNames ? names + ", ..." : names;
}

ZipMember choose(std::vector<ZipMember> members, const std::string& dataset,
                 const std::string& file) {
  std::erase_if(members, [](const ZipMember& member) { return !member.name.ends_with(kSuffix); });
  if (members.empty()) {
    fail_input(file, "npz arrays", "the archive holds none", "save with numpy.savez");
  }
  for (const ZipMember& member : members) {
    if (member.name == dataset || member.name == dataset + ".npy") return member;
  }
  if (!dataset.empty()) {
    fail_input(file, text("npz array '", dataset, "'"), "the archive holds none of that name",
               text("it has ", listed(members)));
  }
  if (members.size() > 1) {
    fail_input(file, "npz arrays", text("the archive holds ", members.size()),
               text("choose one of ", listed(members), " with --dataset"));
  }
  return members.front();
}

/// Bytes of a whole .npy file, by its header, of which read gives the next bytes.
template <class Read>
std::uint64_t npy_file_bytes(Read read, const std::string& name) {
  std::vector<std::byte> start(12);
  read(std::span(start));
  const NpyPrefix prefix = parse_npy_prefix(start, name);
  // With version 1 the dictionary has begun already.
  std::string dict(prefix.dict_length, '\0');
  const std::size_t begun = std::min(start.size() - prefix.dict_offset, dict.size());
  std::copy_n(reinterpret_cast<const char*>(start.data()) + prefix.dict_offset, begun,
              dict.begin());
  read(std::as_writable_bytes(std::span(dict)).subspan(begun));
  const NpyHeader header = parse_npy_dict(dict, name);
  const VolumeInfo info{.shape = header.shape, .type = header.type, .format = "npy"};
  return prefix.dict_offset + prefix.dict_length + payload_bytes(info);
}

/// A deflated member, unpacked.  Its own header bounds it before anything is unpacked to the disk.
std::unique_ptr<ByteSource> inflated(const ByteSource& zip, const ZipMember& member,
                                     const std::string& name) {
  const std::uint64_t offset = zip_data_offset(zip, member);
  const DeflatedBytes index{.offset = offset,
                            .end = offset + member.packed_bytes,
                            .framing = DeflateFraming::kBare,
                            .field = text("npz array '", member.name, "'")};
  Inflater inflater(zip, index);
  const auto read = [&](std::span<std::byte> out) {
    if (inflater.read(out) < out.size()) fail_input(name, "npy header", "truncated");
  };
  const std::uint64_t needed = npy_file_bytes(read, name);
  if (member.bytes != needed) {
    fail_input(name, "npy header",
               text("shape and type need ", needed, " bytes, the member has ", member.bytes),
               "the file is truncated or damaged");
  }
  return inflate_to_scratch(zip, index, needed);
}

}  // namespace

std::unique_ptr<LabelVolume> open_npz(std::unique_ptr<ByteSource> source,
                                      const OpenOptions& options) {
  const ZipMember member = choose(read_zip_directory(*source), options.dataset, source->name());
  const std::string name = text(source->name(), ": ", member.name);
  std::uint64_t offset = 0;
  std::uint64_t size = member.bytes;
  if (member.deflated) {
    source = inflated(*source, member, name);
  } else {
    offset = zip_data_offset(*source, member);
    size = member.packed_bytes;
  }
  auto array = std::make_unique<PartSource>(std::move(source), offset, size, name);
  check_zip_crc(*array, member);
  return open_npy(std::move(array), options);
}

}  // namespace mw::io
