// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A TIFF file that libtiff reads from a ByteSource.
#include "io/volume/tiff/tiff_stack.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>

#include "io/file/errors.h"

namespace mw::io {
namespace {

using Stream = TiffHandle::Stream;

/// Reads fewer bytes at the end.  Errors must not pass through libtiff, so that they become its
/// own, as too few bytes.  Never returns -1: libtiff 4.5 takes it for a length when it clears the
/// rest of a block, and writes in front of its buffer.
tmsize_t read_bytes(thandle_t handle, void* out, tmsize_t count) {
  auto* stream = static_cast<Stream*>(handle);
  const std::uint64_t size = stream->source->size();
  const std::uint64_t left = size - std::min(stream->at, size);
  const auto length =
      static_cast<std::size_t>(std::min<std::uint64_t>(left, static_cast<std::uint64_t>(count)));
  if (length == 0) return 0;
  try {
    stream->source->read_at(stream->at, {static_cast<std::byte*>(out), length});
  } catch (const std::exception& error) {
    stream->complaint = error.what();
    return 0;
  }
  stream->at += length;
  return static_cast<tmsize_t>(length);
}

tmsize_t write_nothing(thandle_t /*handle*/, void* /*bytes*/, tmsize_t /*count*/) {
  return 0;
}

toff_t seek(thandle_t handle, toff_t offset, int from) {
  auto* stream = static_cast<Stream*>(handle);
  if (from == SEEK_CUR) offset += stream->at;
  if (from == SEEK_END) offset += stream->source->size();
  stream->at = offset;
  return offset;
}

int close_nothing(thandle_t /*handle*/) {
  return 0;
}

toff_t size_of(thandle_t handle) {
  return static_cast<Stream*>(handle)->source->size();
}

int keep_complaint(TIFF* /*tiff*/, void* stream, const char* /*module*/, const char* format,
                   va_list values) {
  std::array<char, 400> line{};
  std::vsnprintf(line.data(), line.size(), format, values);
  static_cast<Stream*>(stream)->complaint = line.data();
  return 1;
}

int keep_silent(TIFF* /*tiff*/, void* /*stream*/, const char* /*module*/, const char* /*format*/,
                va_list /*values*/) {
  return 1;
}

struct FreeOptions {
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

/// Returns the most that libtiff may take at once: tables and packed strips fit into the file.
tmsize_t max_memory(std::uint64_t file_bytes) {
  constexpr std::uint64_t kMin = 64 << 20;
  constexpr std::uint64_t kMax = std::uint64_t{1} << 40;
  return static_cast<tmsize_t>(kMin + 2 * std::min(file_bytes, kMax));
}

}  // namespace

TiffHandle::TiffHandle(std::shared_ptr<const ByteSource> source)
    : stream_{.source = std::move(source), .complaint = {}} {
  const std::unique_ptr<TIFFOpenOptions, FreeOptions> options(TIFFOpenOptionsAlloc());
  if (!options) throw Error(ErrorKind::kResource, file() + ": no memory to open it");
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), max_memory(stream_.source->size()));
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_complaint, &stream_);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_silent, nullptr);
  tiff_ = TIFFClientOpenExt(file().c_str(), "rm", &stream_, read_bytes, write_nothing, seek,
                            close_nothing, size_of, nullptr, nullptr, options.get());
  if (tiff_ == nullptr) fail("TIFF header", "cannot be read");
}

TiffHandle::~TiffHandle() {
  if (tiff_ != nullptr) TIFFClose(tiff_);
}

void TiffHandle::go_to(std::uint64_t directory) {
  stream_.complaint.clear();
  if (TIFFCurrentDirOffset(tiff_) == directory) return;
  if (TIFFSetSubDirectory(tiff_, directory) != 1) {
    fail(text("TIFF directory at offset ", directory), "cannot be read");
  }
}

void TiffHandle::fail(std::string_view field, std::string_view reason) const {
  std::string said(reason);
  if (!stream_.complaint.empty()) said += text(" (", stream_.complaint, ")");
  fail_input(file(), field, said, "the file is truncated or damaged");
}

}  // namespace mw::io
