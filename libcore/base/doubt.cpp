// Sentences, groups and totals of doubts about an input.
#include "base/doubt.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"

namespace talus {
namespace {

std::string place_of(const Doubt& doubt) {
  std::string words;
  if (doubt.at.size() == 1 && !std::isnan(doubt.at[0].z()))
    words += " at " + text(doubt.at[0].z(), 8) + " m";
  if (doubt.feature >= 0) words += ", feature " + std::to_string(doubt.feature);
  if (doubt.at.empty()) return words;
  const Vec3 &a = doubt.at.front(), &b = doubt.at.back();
  const auto range = [](double low, double high) {
    return low == high ? text(low, 10) : text(low, 10) + " to " + text(high, 10);
  };
  return words + ", x " + range(a.x(), b.x()) + ", y " + range(a.y(), b.y());
}

std::string joined(const Where& where, const std::string& subject, const Doubt& doubt) {
  std::string words = where.text();
  for (const std::string& part : {subject, doubt.found})
    if (!part.empty()) words += (words.empty() ? "" : ": ") + part;
  if (doubt.expected.empty()) return words;
  return words + (doubt.found.empty() ? ": expected " : "; expected ") + doubt.expected;
}

std::string subject_of(const DoubtGroup& group) {
  const Doubt& first = *group.first;
  if (group.n == 1) return talus::subject_of(first);
  return counted(group.n, first.what) + ", the first" + place_of(first);
}

// The same kind, state and hint; both have a place.
bool is_alike(const Doubt& a, const Doubt& b) {
  return !a.what.empty() && a.what == b.what && a.state == b.state && a.hint == b.hint &&
         !a.at.empty() && !b.at.empty();
}

}  // namespace

std::string Where::text() const {
  std::string place = file;
  if (line > 0) place += ":" + std::to_string(line);
  if (!item.empty()) place += place.empty() ? item : ": " + item;
  return place;
}

const char* text(DoubtState state) {
  switch (state) {
    case DoubtState::in_doubt:
      return "in doubt";
    case DoubtState::mended:
      return "mended";
    case DoubtState::accepted:
      return "accepted";
    case DoubtState::refused:
      return "refused";
  }
  return "";
}

Doubt doubt_on(const Where& where, std::string found, std::string hint) {
  Doubt doubt;
  doubt.where = where, doubt.found = std::move(found), doubt.hint = std::move(hint);
  return doubt;
}

std::string subject_of(const Doubt& doubt) {
  return doubt.what.empty() ? std::string() : doubt.what + place_of(doubt);
}

std::string sentence_on(const Doubt& doubt) {
  return joined(doubt.where, subject_of(doubt), doubt);
}

std::vector<DoubtGroup> groups_of(const std::vector<Doubt>& doubts) {
  std::vector<DoubtGroup> groups;
  for (const Doubt& doubt : doubts) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const DoubtGroup& group) {
      return is_alike(*group.first, doubt);
    });
    if (same == groups.end())
      groups.push_back({&doubt, doubt.n});
    else
      same->n += doubt.n;
  }
  return groups;
}

std::string sentence_on(const DoubtGroup& group) {
  return joined(group.first->where, subject_of(group), *group.first);
}

void accept(std::vector<Doubt>& doubts) {
  for (Doubt& doubt : doubts)
    if (doubt.state == DoubtState::refused) doubt.state = DoubtState::accepted;
}

std::string accepted_places(const std::vector<Doubt>& doubts) {
  constexpr std::int64_t most = 20;
  std::int64_t n = 0;
  std::string words;
  for (const Doubt& doubt : doubts)
    if (doubt.state == DoubtState::accepted && ++n <= most)
      words += (words.empty() ? "" : "; ") + subject_of(doubt);
  if (n > most) words += "; " + std::to_string(n - most) + " more";
  return words;
}

Doubt refusal_of(const std::vector<Doubt>& doubts) {
  std::vector<DoubtGroup> groups = groups_of(doubts);
  std::erase_if(groups,
                [](const DoubtGroup& group) { return group.first->state != DoubtState::refused; });
  if (groups.empty()) return {};
  if (groups.size() == 1 && groups[0].n == 1) return *groups[0].first;
  Doubt all;
  all.where = groups[0].first->where, all.hint = groups[0].first->hint;
  all.state = DoubtState::refused;
  for (const DoubtGroup& group : groups) {
    const Doubt& first = *group.first;
    all.found += (all.found.empty() ? "" : "; ") + joined({}, subject_of(group), first);
  }
  return all;
}

}  // namespace talus
