// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks xz.
#include <lzma.h>

#include <memory>

#include "io/codec/codec.h"
#include "io/codec/stream.h"

namespace mw::io {
namespace {

/// Returns the reason of an error, or null for a verdict that is none.
const char* why_wrong(lzma_ret verdict) {
  switch (verdict) {
    case LZMA_OK:
    case LZMA_STREAM_END:
    case LZMA_BUF_ERROR:
      return nullptr;
    case LZMA_FORMAT_ERROR:
      return "not the xz format";
    case LZMA_MEMLIMIT_ERROR:
      return "asks for a dictionary above 64 MiB";
    case LZMA_OPTIONS_ERROR:
      return "asks for a filter that is not known";
    default:
      return "damaged";
  }
}

class XzDecoder : public StreamDecoder {
 public:
  explicit XzDecoder(const PackedName& name) : name_(name) { restart(); }
  ~XzDecoder() override { lzma_end(&stream_); }
  XzDecoder(const XzDecoder&) = delete;
  XzDecoder& operator=(const XzDecoder&) = delete;

  [[nodiscard]] Step step(std::span<const std::byte> packed, std::span<std::byte> out) override {
    stream_.next_in = reinterpret_cast<const std::uint8_t*>(packed.data());
    stream_.avail_in = packed.size();
    stream_.next_out = reinterpret_cast<std::uint8_t*>(out.data());
    stream_.avail_out = out.size();
    const lzma_ret verdict = lzma_code(&stream_, LZMA_RUN);
    if (verdict == LZMA_MEM_ERROR) fail_no_memory(name_);
    return {.taken = packed.size() - stream_.avail_in,
            .given = out.size() - stream_.avail_out,
            .ended = verdict == LZMA_STREAM_END,
            .wrong = why_wrong(verdict)};
  }
  void restart() override {
    if (lzma_stream_decoder(&stream_, kMaxXzBytes, /*flags=*/0) != LZMA_OK) fail_no_memory(name_);
  }

 private:
  PackedName name_;
  lzma_stream stream_ = LZMA_STREAM_INIT;
};

}  // namespace

std::unique_ptr<StreamDecoder> xz_decoder(const PackedName& name) {
  return std::make_unique<XzDecoder>(name);
}

}  // namespace mw::io
