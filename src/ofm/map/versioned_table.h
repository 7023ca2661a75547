// Objects by id, of which an immutable copy of all can be had at any time for the price of a list
// of pointers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {

/// Objects of consecutive ids. Table and snapshots share it until the table changes it; where all
/// of its objects are gone there is none.
template <class T>
struct TableChunk {
  static constexpr std::size_t kSize = 32;

  std::array<std::shared_ptr<T>, kSize> objects;  ///< null where removed or not issued yet
  std::array<std::uint64_t, kSize> versions{};  ///< of the table when an object was made or copied
  std::uint64_t version = 0;                    ///< likewise of the chunk itself; 0 = of no table

  bool IsEmpty() const {
    return std::all_of(objects.begin(), objects.end(), [](const auto& o) { return o == nullptr; });
  }
};

/// An immutable view of a VersionedTable: object by id, null where it was removed.
template <class Id, class T>
class TableSnapshot {
 public:
  TableSnapshot() = default;
  /// Of these objects by id, null where there is none.
  explicit TableSnapshot(const std::vector<std::shared_ptr<const T>>& objects)
      : ids_issued_(objects.size()) {
    chunks_.resize((objects.size() + Chunk::kSize - 1) / Chunk::kSize);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (!objects[i]) continue;
      std::shared_ptr<Chunk>& chunk = chunks_[i / Chunk::kSize];
      if (!chunk) chunk = std::make_shared<Chunk>();
      // A table that goes on from here copies it before it is changed.
      chunk->objects[i % Chunk::kSize] = std::const_pointer_cast<T>(objects[i]);
    }
  }

  /// Null where there is no such object.
  const T* Find(Id id) const {
    const std::size_t index = id.value / Chunk::kSize;
    if (index >= chunks_.size() || !chunks_[index]) return nullptr;
    return chunks_[index]->objects[id.value % Chunk::kSize].get();
  }
  /// Number of ids that were issued; the next one.
  std::size_t ids_issued() const { return ids_issued_; }
  /// Calls `visit(const T&)` by increasing id.
  template <class Visit>
  void ForEach(Visit&& visit) const {
    for (const auto& chunk : chunks_) {
      if (!chunk) continue;
      for (const auto& object : chunk->objects) {
        if (object) visit(static_cast<const T&>(*object));
      }
    }
  }

 private:
  using Chunk = TableChunk<T>;
  template <class, class>
  friend class VersionedTable;

  std::vector<std::shared_ptr<Chunk>> chunks_;  // only a table changes them, and those of its own
  std::size_t ids_issued_ = 0;
  std::uint64_t version_ = 1;  // above that of each chunk and object
};

/// Owner of objects with ids issued in increasing order. An object that a snapshot shares is copied
/// before it is changed, so a snapshot never changes and its reader needs no lock. One writer.
/// What is gone costs a pointer for each chunk of ids.
template <class Id, class T>
class VersionedTable {
 public:
  VersionedTable() = default;
  /// A table that goes on from `snapshot`, under the same ids.
  explicit VersionedTable(const TableSnapshot<Id, T>& snapshot) : now_(snapshot) {
    ForEach([&](const T&) { ++size_; });
  }

  /// Takes ownership; sets and returns the object's id.
  Id Insert(T object) {
    const Id id(static_cast<std::uint32_t>(now_.ids_issued_++));
    object.id = id;
    if (id.value % Chunk::kSize == 0) now_.chunks_.emplace_back();
    Chunk& chunk = OwnChunk(id);
    chunk.objects[id.value % Chunk::kSize] = std::make_shared<T>(std::move(object));
    chunk.versions[id.value % Chunk::kSize] = now_.version_;
    ++size_;
    return id;
  }

  const T* Find(Id id) const { return now_.Find(id); }
  const T& Get(Id id) const {
    const T* object = Find(id);
    OFM_CHECK(object != nullptr);
    return *object;
  }
  /// The object for writing; references from before are stale.
  T& Edit(Id id) {
    OFM_CHECK(Find(id) != nullptr);
    Chunk& chunk = OwnChunk(id);
    std::shared_ptr<T>& object = chunk.objects[id.value % Chunk::kSize];
    std::uint64_t& version = chunk.versions[id.value % Chunk::kSize];
    if (version != now_.version_) {
      object = std::make_shared<T>(*object);
      version = now_.version_;
    }
    return *object;
  }
  void Erase(Id id) {
    OFM_CHECK(Find(id) != nullptr);
    Chunk& chunk = OwnChunk(id);
    chunk.objects[id.value % Chunk::kSize].reset();
    --size_;
    if (chunk.IsEmpty()) now_.chunks_[id.value / Chunk::kSize].reset();
  }

  std::size_t size() const { return size_; }
  template <class Visit>
  void ForEach(Visit&& visit) const {
    now_.ForEach(visit);
  }

  TableSnapshot<Id, T> Snapshot() {
    ++now_.version_;
    return now_;
  }

 private:
  using Chunk = TableChunk<T>;

  /// The chunk of an id as one that no snapshot shares.
  Chunk& OwnChunk(Id id) {
    std::shared_ptr<Chunk>& chunk = now_.chunks_[id.value / Chunk::kSize];
    if (!chunk || chunk->version != now_.version_) {
      chunk = chunk ? std::make_shared<Chunk>(*chunk) : std::make_shared<Chunk>();
      chunk->version = now_.version_;
    }
    return *chunk;
  }

  TableSnapshot<Id, T> now_;  // what a snapshot taken now would show
  std::size_t size_ = 0;
};

}  // namespace ofm
