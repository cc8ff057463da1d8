#include "graph/values/heap_archive.h"

#include <algorithm>
#include <cstring>

namespace jarol {
namespace {

constexpr std::uint64_t no_place = ~std::uint64_t{0};

// Bytes of a block of that class: as heap.cpp counts them.
std::size_t size_of_class(std::size_t index) {
  if (index < 4) return (index + 1) * smallest_heap;
  const std::size_t exponent = (index - 4) / 4 + 7;
  return ((index - 4) % 4 + 5) << (exponent - 3);
}

// Of such alone some bytes are no value.
bool has_bool(const Type& type) {
  if (type.element != nullptr) return has_bool(*type.element);
  return type.kind == Kind::boolean || std::any_of(type.fields.begin(), type.fields.end(),
                                                   [](const TypeField& field) { return has_bool(*field.type); });
}

}  // namespace

// Free blocks as they will be used: the next one of each size first.
void PrivateHeap::serialize(Archive& archive, std::vector<Block>& free) {
  archive(book_.values, max_used_);
  archive.require(book_.values <= size_ && book_.values % smallest_heap == 0 && max_used_ <= size_,
                  "has a heap too large");
  if (archive.restores()) book_ = {{}, book_.values, size_};
  std::vector<std::pair<std::uint32_t, std::uint64_t>> blocks;  // class and place
  for (std::uint32_t c = 0; c < book_.free.size(); ++c)
    for (const void* block = book_.free[c]; block != nullptr; std::memcpy(&block, block, sizeof block))
      blocks.emplace_back(c, place_of(block));
  archive(blocks);
  for (std::size_t i = blocks.size(); i-- > 0;) {
    const auto [c, place] = blocks[i];
    const bool is_class = c < book_.free.size() && size_of_class(c) <= book_.values;
    archive.require(is_class && place % smallest_heap == 0 && place <= book_.values - size_of_class(c),
                    "has a free block beyond its heap");
    free.emplace_back(place, size_of_class(c));
    if (!archive.restores()) continue;
    std::memcpy(at(place), &book_.free[c], sizeof(void*));
    book_.free[c] = at(place);
  }
}

HeapArchive::HeapArchive(Archive& archive, PrivateHeap& heap) : archive_(archive), heap_(heap) {
  heap.serialize(archive, blocks_);
}

void HeapArchive::value(const Type& type, void* value) {
  const MemoryScope scope(&forgotten_);
  deep(type, static_cast<std::byte*>(value));
}

void HeapArchive::deep(const Type& type, std::byte* value) {
  if (!type.is_deep()) return archive_.value(type, value);
  if (type.length != nullptr) return elements_of(type, value);
  for (const TypeField& field : type.fields) deep(*field.type, value + field.offset);
  for (std::size_t i = 0; type.kind == Kind::array && i < type.count; ++i)
    deep(*type.element, value + i * type.element->size);
}

void HeapArchive::elements_of(const Type& type, void* value) {
  const bool flat = type.element == nullptr || !type.element->is_deep();
  const std::size_t size = type.element == nullptr ? 1 : type.element->size;
  std::uint64_t length = 0, capacity = 0, place = no_place;
  if (!archive_.restores()) {
    length = type.length(value);
    capacity = type.capacity(value);
    if (capacity > 0) place = heap_.place_of(type.elements(value));
  }
  archive_(length, capacity, place);
  archive_.require(length <= capacity && (capacity == 0) == (place == no_place), "has a sequence without room");
  if (capacity > 0) {
    const std::size_t end = heap_.end_of_values();
    archive_.require(capacity <= end / size, "has a sequence larger than its heap");
    const std::size_t block = PrivateHeap::block_size(capacity * size);
    archive_.require(place % smallest_heap == 0 && block <= end && place <= end - block,
                     "has a sequence beyond its heap");
    blocks_.emplace_back(place, block);
  }
  std::byte* const elements = capacity > 0 ? heap_.at(place) : nullptr;
  if (archive_.restores()) {
    for (std::size_t i = 0; type.element != nullptr && i < length; ++i) type.element->construct(elements + i * size);
    type.lie_in(value, heap_.values(), elements, length, capacity);
  }
  if (type.element == nullptr) return archive_.bytes(elements, length);
  if (flat && !archive_.restores() && !has_bool(*type.element)) return archive_.bytes(elements, length * size);
  for (std::size_t i = 0; i < length; ++i) {
    std::byte* const element = elements + i * size;
    flat ? archive_.value(*type.element, element) : deep(*type.element, element);
  }
}

// A block that two had would be written by both.
void HeapArchive::finish() {
  if (!archive_.restores()) return;
  std::sort(blocks_.begin(), blocks_.end());
  std::size_t end = 0;
  for (const auto& [place, size] : blocks_) {
    archive_.require(place >= end, "has two values in one place");
    end = place + size;
  }
}

}  // namespace jarol
