// tools/frame/tool.hpp: options by CLI11, whose header costs seconds and is read by few sources.
#include <CLI/CLI.hpp>

#include "tools/frame/tool.hpp"

namespace talus {

const ToolOption& ToolOption::required(bool is) const { return option_->required(is), *this; }

const ToolOption& ToolOption::needs(const ToolOption& other) const {
  return option_->needs(other.option_), *this;
}

const ToolOption& ToolOption::one_of(const std::vector<std::string>& words) const {
  return option_->check(CLI::IsMember(words)), *this;
}

const ToolOption& ToolOption::between(int low, int high) const {
  return option_->check(CLI::Range(low, high)), *this;
}

const ToolOption& ToolOption::between(std::int64_t low, std::int64_t high) const {
  return option_->check(CLI::Range(low, high)), *this;
}

const ToolOption& ToolOption::between(double low, double high) const {
  return option_->check(CLI::Range(low, high)), *this;
}

const ToolOption& ToolOption::positive() const {
  return option_->check(CLI::PositiveNumber), *this;
}

const ToolOption& ToolOption::not_negative() const {
  return option_->check(CLI::NonNegativeNumber), *this;
}

const ToolOption& ToolOption::existing_file() const {
  return option_->check(CLI::ExistingFile), *this;
}

const ToolOption& ToolOption::check(
    const std::function<std::string(const std::string&)>& fault_of) const {
  return option_->check(fault_of), *this;
}

const ToolOption& ToolOption::without_default() const { return option_->default_str(""), *this; }

bool ToolOption::is_given() const { return option_->count() > 0; }

template <class T>
ToolOption Tool::option(const std::string& name, T& value, const std::string& help) {
  return ToolOption(app().add_option(name, value, help)->capture_default_str());
}

template ToolOption Tool::option(const std::string&, double&, const std::string&);
template ToolOption Tool::option(const std::string&, int&, const std::string&);
template ToolOption Tool::option(const std::string&, std::int64_t&, const std::string&);
template ToolOption Tool::option(const std::string&, std::string&, const std::string&);

ToolOption Tool::option(const std::string& name,
                        const std::function<void(const std::string&)>& take,
                        const std::string& help) {
  return ToolOption(app().add_option_function<std::string>(name, take, help));
}

ToolOption Tool::list(const std::string& name, std::vector<std::string>& words,
                      const std::string& help) {
  return ToolOption(app().add_option(name, words, help)->allow_extra_args(name[0] != '-'));
}

ToolOption Tool::flag(const std::string& name, bool& value, const std::string& help) {
  return ToolOption(app().add_flag(name, value, help));
}

ToolOption Tool::flag(const std::string& name, std::string& word, const std::string& help) {
  return ToolOption(app().add_flag(name, word, help));
}

}  // namespace talus
