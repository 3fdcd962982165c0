#include "rhombicSettings.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <memory>
#include <sstream>

namespace rhombic
{
namespace
{

/** \class GivenItems
 * \brief Settings for CLI11, which takes what it calls a configuration from a stream; the stream is not read. */
class GivenItems : public CLI::Config
{
public:
  explicit GivenItems(std::vector<CLI::ConfigItem> given)
    : m_Given(std::move(given))
  {}

  std::string
  to_config(const CLI::App *, bool, bool, std::string) const override
  {
    return "";
  }

  std::vector<CLI::ConfigItem>
  from_config(std::istream &) const override
  {
    return m_Given;
  }

private:
  std::vector<CLI::ConfigItem> m_Given;
};

std::vector<std::string>
ToTexts(const Report & value)
{
  std::vector<std::string> texts;
  for (const Report & item : value.is_array() ? value : Report::array({ value }))
  {
    texts.push_back(item.is_string() ? item.get<std::string>() : item.dump());
  }
  return texts;
}

Report
ToValue(const std::string & text, bool isNumber)
{
  const Report number = isNumber ? Report::parse(text, nullptr, false) : Report();
  return number.is_number() ? number : Report(text);
}

/** "SCAN", or "LABELS2" for the second of a list. */
std::string
Placeholder(const std::string & key, std::size_t position)
{
  std::string name = key;
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
  return name + (position > 0 ? std::to_string(position + 1) : "");
}

bool
IsFlag(const CLI::Option & option)
{
  return option.get_items_expected_max() == 0;
}

} // namespace

void
CommandSettings::AddRow(CLI::Option * option, bool isNumber, const std::vector<SettingTrait> & traits)
{
  const bool isNamedByPlace = option->get_lnames().empty();
  if (option->get_items_expected_max() > 1 && !isNamedByPlace)
  {
    option->allow_extra_args(false);
  }
  m_Rows.push_back({ isNamedByPlace ? LowerCase(option->get_name()) : option->get_lnames().front(), option, isNumber });
  for (const SettingTrait & trait : traits)
  {
    trait(m_Rows.back());
  }
}

void
CommandSettings::Relate()
{
  for (const SettingRow & row : m_Rows)
  {
    for (const std::string & name : row.excludes)
    {
      row.option->excludes(m_Parser.get_option(name));
    }
    for (const std::string & name : row.needs)
    {
      row.option->needs(m_Parser.get_option(name));
    }
  }
}

Report
CommandSettings::Get() const
{
  Report settings = Report::object();
  for (const SettingRow & row : m_Rows)
  {
    if (row.option->count() == 0)
    {
      continue;
    }
    Report & value = settings[row.key];
    if (IsFlag(*row.option))
    {
      value = true;
      continue;
    }
    for (const std::string & text : row.option->results())
    {
      value.push_back(ToValue(text, row.isNumber));
    }
    if (row.option->get_items_expected_max() == 1)
    {
      value = Report(value[0]);
    }
  }
  return settings;
}

Report
CommandSettings::GetRecorded() const
{
  const Report given = this->Get();
  Report recorded = Report::object();
  for (const SettingRow & row : m_Rows)
  {
    if (!given.contains(row.key) || row.kind == SettingKind::Output || row.kind == SettingKind::Run)
    {
      continue;
    }
    std::size_t position = 0;
    const auto hide = [&row, &position](Report & value) {
      if (row.kind == SettingKind::Source)
      {
        value = Placeholder(row.key, position++);
      }
      else if (row.kind == SettingKind::InputFile)
      {
        value = std::filesystem::path(value.get<std::string>()).filename().string();
      }
    };
    Report & value = recorded[row.key] = given[row.key];
    if (value.is_array())
    {
      std::for_each(value.begin(), value.end(), hide);
    }
    else
    {
      hide(value);
    }
  }
  return recorded;
}

std::string
CommandSettings::GetRecordedCommand() const
{
  const Report recorded = this->GetRecorded();
  std::string places;
  std::string options;
  for (const SettingRow & row : m_Rows)
  {
    if (!recorded.contains(row.key))
    {
      continue;
    }
    for (const std::string & text : ToTexts(recorded[row.key]))
    {
      if (row.option->get_lnames().empty())
      {
        places += " " + text;
      }
      else
      {
        options += " --" + row.key + (IsFlag(*row.option) ? "" : "=" + text);
      }
    }
  }
  return "rhombic " + this->GetCommand() + places + options;
}

void
CommandSettings::Set(const Report & settings)
{
  std::vector<std::string> known;
  std::transform(
    m_Rows.begin(), m_Rows.end(), std::back_inserter(known), [](const SettingRow & row) { return row.key; });
  std::vector<CLI::ConfigItem> items;
  for (const auto & [key, value] : settings.items())
  {
    const auto row =
      std::find_if(m_Rows.begin(), m_Rows.end(), [&key = key](const SettingRow & r) { return r.key == key; });
    if (row == m_Rows.end())
    {
      throw Failure(FailureKind::Usage,
                    DescribeUnknown("setting of rhombic " + this->GetCommand(),
                                    key,
                                    known,
                                    "see rhombic " + this->GetCommand() + " --help for all of them"));
    }
    if (value == Report(false))
    {
      continue;
    }
    const auto & names = row->option->get_lnames();
    items.push_back({ {}, names.empty() ? row->option->get_name() : names.front(), ToTexts(value) });
  }
  m_Parser.config_formatter(std::make_shared<GivenItems>(items));
  std::istringstream unread;
  m_Parser.parse_from_stream(unread);
}

void
CommandSettings::SetRecorded(Report settings)
{
  const auto isGiven = [this](const std::string & name) { return m_Parser.get_option(name)->count() > 0; };
  for (const SettingRow & row : m_Rows)
  {
    if (row.kind != SettingKind::Source || settings.erase(row.key) == 0)
    {
      continue;
    }
    const std::string name = "--" + row.key;
    const bool isReplaced =
      std::any_of(row.excludes.begin(), row.excludes.end(), isGiven) ||
      std::any_of(m_Rows.begin(), m_Rows.end(), [&name](const SettingRow & other) {
        return other.option->count() > 0 && std::count(other.excludes.begin(), other.excludes.end(), name) > 0;
      });
    const bool tellsWhatIsDrawn = !row.option->get_lnames().empty() && row.key != "series";
    if (tellsWhatIsDrawn && row.option->count() == 0 && !isReplaced)
    {
      throw Failure(FailureKind::Usage,
                    "The report was made with " + name + ", of which it holds no names; give " + name + " again.");
    }
  }
  this->Set(settings);
}

std::vector<std::pair<std::string, SettingKind>>
CommandSettings::GetNames() const
{
  std::vector<std::pair<std::string, SettingKind>> names;
  for (const SettingRow & row : m_Rows)
  {
    if (!row.option->get_lnames().empty() && !row.option->get_group().empty())
    {
      names.emplace_back(row.key, row.kind);
    }
  }
  return names;
}

} // namespace rhombic
