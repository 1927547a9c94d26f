// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The digest of a mesh's content.
#include "io/mesh/digest.h"

#include <openssl/evp.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <numeric>
#include <string_view>

#include "io/file/byte_order.h"
#include "kernels/core/error.h"

namespace mw::io {
namespace {

/// SHA-256 of a stream of 64-bit words.
class Hasher {
 public:
  Hasher() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    check(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }

  void add(std::string_view characters) {
    flush();
    check(EVP_DigestUpdate(context_.get(), characters.data(), characters.size()) == 1);
  }
  void add(std::uint64_t word) {
    buffer_.resize(buffer_.size() + sizeof word);
    store_little(word, buffer_.data() + buffer_.size() - sizeof word);
    if (buffer_.size() >= kBufferBytes) flush();
  }
  [[nodiscard]] std::string finish() {
    flush();
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned length = 0;
    check(EVP_DigestFinal_ex(context_.get(), bytes.data(), &length) == 1);
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string hex;
    for (unsigned i = 0; i < length; ++i) {
      hex.push_back(kDigits[bytes[i] >> 4]);
      hex.push_back(kDigits[bytes[i] & 15]);
    }
    return hex;
  }

 private:
  static constexpr std::size_t kBufferBytes = 1 << 16;

  static void check(bool done) {
    if (!done) throw Error(ErrorKind::kInternal, "SHA-256 is not available in this OpenSSL");
  }
  void flush() {
    check(EVP_DigestUpdate(context_.get(), buffer_.data(), buffer_.size()) == 1);
    buffer_.clear();
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
  std::vector<std::byte> buffer_;
};

/// Bits that order like the double they stand for; a total order, whatever the double.
std::uint64_t sortable(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x);
  return (bits >> 63) != 0 ? ~bits : bits | std::uint64_t{1} << 63;
}

double unsortable(std::uint64_t key) {
  return std::bit_cast<double>((key >> 63) != 0 ? key & ~(std::uint64_t{1} << 63) : ~key);
}

struct Vertex {
  std::array<std::uint64_t, 3> key;
  std::uint64_t row;
};

/// The vertices in order of position; rank[row] is the number of those before a row's position.
std::vector<Vertex> sort_vertices(const MeshData& mesh, std::vector<std::uint64_t>& rank) {
  std::vector<Vertex> vertices(mesh.vertices.size());
  for (std::size_t row = 0; row < vertices.size(); ++row) {
    const Position& p = mesh.vertices[row];
    vertices[row] = {{sortable(p[0]), sortable(p[1]), sortable(p[2])}, row};
  }
  std::sort(vertices.begin(), vertices.end(),
            [](const Vertex& a, const Vertex& b) { return a.key < b.key; });
  rank.resize(vertices.size());
  std::uint64_t first = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i].key != vertices[first].key) first = i;
    rank[vertices[i].row] = first;
  }
  return vertices;
}

using TetKey = std::array<std::uint64_t, 5>;

std::vector<TetKey> sort_tets(const MeshData& mesh, const std::vector<std::uint64_t>& rank) {
  std::vector<TetKey> tets(mesh.tets.size());
  for (std::size_t i = 0; i < tets.size(); ++i) {
    const TetRows& rows = mesh.tets[i];
    tets[i] = {rank[rows[0]], rank[rows[1]], rank[rows[2]], rank[rows[3]], mesh.labels[i]};
    std::sort(tets[i].begin(), tets[i].begin() + 4);
  }
  std::sort(tets.begin(), tets.end());
  return tets;
}

}  // namespace

std::string mesh_digest(const MeshData& mesh) {
  Hasher hasher;
  hasher.add(std::string_view("mwmesh-digest-1"));
  hasher.add(std::uint64_t{mesh.vertices.size()});
  hasher.add(std::uint64_t{mesh.tets.size()});
  std::vector<std::uint64_t> rank;
  for (const Vertex& vertex : sort_vertices(mesh, rank)) {
    for (const std::uint64_t key : vertex.key) {
      hasher.add(std::bit_cast<std::uint64_t>(unsortable(key)));
    }
  }
  for (const TetKey& tet : sort_tets(mesh, rank)) {
    for (const std::uint64_t number : tet) hasher.add(number);
  }
  return "sha256:" + hasher.finish();
}

}  // namespace mw::io
