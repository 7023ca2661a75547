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

  std::vector<std::shared_ptr<Chunk>> chunks_;  // never changed through here
  std::size_t ids_issued_ = 0;
  std::uint64_t version_ = 1;  // above that of each object
};

/// Owner of objects with ids issued in increasing order. An object that a snapshot shares is copied
/// before it is changed, so a snapshot never changes and its reader needs no lock. One writer.
/// What is gone costs a pointer for each chunk of ids.
template <class Id, class T>
class VersionedTable {
 public:
  VersionedTable() = default;
  /// A table that goes on from `snapshot`, under the same ids.
  explicit VersionedTable(const TableSnapshot<Id, T>& snapshot)
      : ids_issued_(snapshot.ids_issued_), version_(snapshot.version_) {
    slots_.reserve(snapshot.chunks_.size());
    for (const auto& chunk : snapshot.chunks_) slots_.push_back({chunk, 0});
    snapshot.ForEach([&](const T&) { ++size_; });
  }

  /// Takes ownership; sets and returns the object's id.
  Id Insert(T object) {
    const Id id(static_cast<std::uint32_t>(ids_issued_));
    object.id = id;
    if (id.value % Chunk::kSize == 0) slots_.emplace_back();
    Chunk& chunk = OwnChunk(id);
    chunk.objects[id.value % Chunk::kSize] = std::make_shared<T>(std::move(object));
    chunk.versions[id.value % Chunk::kSize] = version_;
    ++ids_issued_;
    ++size_;
    return id;
  }

  const T* Find(Id id) const {
    const std::size_t index = id.value / Chunk::kSize;
    if (index >= slots_.size() || !slots_[index].chunk) return nullptr;
    return slots_[index].chunk->objects[id.value % Chunk::kSize].get();
  }
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
    if (version != version_) {
      object = std::make_shared<T>(*object);
      version = version_;
    }
    return *object;
  }
  void Erase(Id id) {
    OFM_CHECK(Find(id) != nullptr);
    Chunk& chunk = OwnChunk(id);
    chunk.objects[id.value % Chunk::kSize].reset();
    --size_;
    if (chunk.IsEmpty()) slots_[id.value / Chunk::kSize].chunk.reset();
  }

  std::size_t size() const { return size_; }
  template <class Visit>
  void ForEach(Visit&& visit) const {
    for (const Slot& slot : slots_) {
      if (!slot.chunk) continue;
      for (const auto& object : slot.chunk->objects) {
        if (object) visit(static_cast<const T&>(*object));
      }
    }
  }

  TableSnapshot<Id, T> Snapshot() {
    ++version_;
    TableSnapshot<Id, T> snapshot;
    snapshot.chunks_.reserve(slots_.size());
    for (const Slot& slot : slots_) snapshot.chunks_.push_back(slot.chunk);
    snapshot.ids_issued_ = ids_issued_;
    snapshot.version_ = version_;
    return snapshot;
  }

 private:
  using Chunk = TableChunk<T>;
  struct Slot {
    std::shared_ptr<Chunk> chunk;
    std::uint64_t version = 0;  // of the table when the chunk was made or copied
  };

  /// The chunk of an id as one that no snapshot shares.
  Chunk& OwnChunk(Id id) {
    Slot& slot = slots_[id.value / Chunk::kSize];
    if (!slot.chunk) {
      slot = {std::make_shared<Chunk>(), version_};
    } else if (slot.version != version_) {
      slot = {std::make_shared<Chunk>(*slot.chunk), version_};
    }
    return *slot.chunk;
  }

  std::vector<Slot> slots_;  // by id, for TableChunk::kSize ids each
  std::size_t ids_issued_ = 0;
  std::size_t size_ = 0;
  std::uint64_t version_ = 1;  // objects that were never part of a table of this kind are of 0
};

}  // namespace ofm
