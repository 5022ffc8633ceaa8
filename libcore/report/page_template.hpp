// libcore/report/page_template.hpp: public
// A page from a template with holes: HTML is in the template, words in texts, values in data.
// in:    a template, a part a section of the page; data as JSON; texts
// out:   HTML. The marks:
//
//   {{path}} {{path|format}}   a value: escaped text, a number with three digits, a dash for none
//   {{=key name=path|format}}  a text of the page with values; the rest is taken from the data
//   {{=group.@path}}           the text whose last name is the value, translated where none is
//   {{*key lnn}}               heads of a table, letters say which columns are numbers
//   {{#path}} ... {{/}}        once for each entry of a list; within an object
//   {{?path}} {{^path}}        where there is something; where there is nothing
//   {{#path=value}}            where it is that
//   {{+part}}                  another part; {{@part}} alone on a line begins one
// Formats: digits, percent, needed (rounded up), whole, years (of a rate), raw (HTML), said (words
// of other tools, translated). Within entries: . the entry, @key its name, @n its number, @first.
// Members of an object as entries: path.*
#pragma once

#include <string>

#include "report/texts.hpp"

namespace talus {

/// The part "page" of a template. Its {{sections}} are the parts that the text page.sections names,
/// in this order, those that hold anything: id, nav, title, body. Throws InputError with the
/// template's line for marks that are not understood.
[[nodiscard]] std::string filled_page(const std::string& name, const std::string& content,
                                      const std::string& data_json, const Texts& texts);

}  // namespace talus
