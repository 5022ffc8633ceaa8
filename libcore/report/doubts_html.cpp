// Doubts on a page: a numbered line each, by kind, with their remedy.
#include "report/doubts_html.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "report/html.hpp"

namespace talus {

std::string doubts_html(const std::vector<Doubt>& doubts, const std::string& if_none) {
  std::string out;
  int number = 0;
  for (const DoubtGroup& group : groups_of(doubts)) {
    const Doubt& doubt = *group.first;
    const bool is_open = doubt.state == DoubtState::in_doubt;
    out += html_verdict(doubt.state == DoubtState::refused ? "fail" : "warn",
                        "<b>" + std::to_string(++number) + "</b> " +
                            (is_open ? "" : "<b>" + std::string(text(doubt.state)) + ":</b> ") +
                            xml_escaped(sentence_on(group)) + ".<br>" + xml_escaped(doubt.hint));
  }
  return out.empty() ? html_verdict("pass", if_none) : out;
}

std::vector<DoubtMark> marks_of(const std::vector<Doubt>& doubts, const Vec3& origin) {
  const std::vector<DoubtGroup> groups = groups_of(doubts);
  std::vector<DoubtMark> marks;
  for (const Doubt& doubt : doubts) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const DoubtGroup& g) {
      return g.first == &doubt || groups_of({*g.first, doubt}).size() == 1;
    });
    DoubtMark mark;
    mark.number = static_cast<int>(group - groups.begin()) + 1;
    for (const Vec3& at : doubt.at) mark.at.emplace_back((at - origin).head<2>());
    mark.title = sentence_on(doubt);
    if (!mark.at.empty()) marks.push_back(std::move(mark));
  }
  return marks;
}

}  // namespace talus
