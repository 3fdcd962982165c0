#ifndef rhombicSettings_h
#define rhombicSettings_h

#include "rhombicFailure.h"
#include "rhombicScanReport.h"
#include "rhombicWording.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace rhombic
{

/** What a setting names, which decides what reports hold of it. */
enum class SettingKind
{
  Value,     ///< a value: reports hold it
  InputFile, ///< a file without patient data, as a preset: reports hold its name without folders
  Source,    ///< a scan, a series or a label map, whose name may identify the patient: reports hold its setting's name
  Output,    ///< a file or folder that is written: reports leave it out
  Run        ///< how the command runs, as its memory, with the same outputs: reports leave it out
};

/** \class SettingRow
 * \brief A setting of a command: its option, and what reports and JSON hold of it. */
struct SettingRow
{
  std::string key; ///< in JSON
  CLI::Option * option;
  bool isNumber;
  SettingKind kind = SettingKind::Value;
  std::vector<std::string> excludes{}; ///< names of settings, with dashes, that do not go with this one
  std::vector<std::string> needs{};    ///< names of settings, with dashes, without which this one has no effect
};

/** What a row of a table of settings says beyond name, member and help text: one of those that follow. */
using SettingTrait = std::function<void(SettingRow &)>;

inline const auto InBytes = [](SettingRow & row) { ///< or as 8G
  row.option->transform(CLI::AsSizeValue(false).operation([size = CLI::AsSizeValue(false)](std::string & text) {
    const std::string given = text;
    try
    {
      return given.find('-') == std::string::npos ? size(text) : throw CLI::ValidationError(given);
    }
    catch (const CLI::ValidationError &)
    {
      return "'" + given + "' is no size from 0 on, as 8G or 500M";
    }
  }));
};
inline const auto SplitAtCommas = [](SettingRow & row) { row.option->delimiter(','); };            ///< "--option A,B"
inline const auto SeveralBehindOneName = [](SettingRow & row) { row.option->allow_extra_args(); }; ///< "--option A B"
inline const auto ShowingDefault = [](SettingRow & row) { row.option->capture_default_str(); };    ///< in the help text
inline const auto Hidden = [](SettingRow & row) { row.option->group(""); }; ///< from the help text
inline const auto Required = [](SettingRow & row) { row.option->required(); };

inline const auto OfKind = [](SettingKind kind) { return [kind](SettingRow & row) { row.kind = kind; }; };

/** A check of each value. */
inline const auto Checked = [](const CLI::Validator & check) {
  return [check](SettingRow & row) { row.option->check(check); };
};

/** CLI11's check, whose own sentence tells the largest number there is, in 309 digits. */
inline const auto CheckedAs = [](const CLI::Validator & check, const std::string & what) {
  return Checked(CLI::Validator(check).operation([check, what](std::string & text) {
    return check(text).empty() ? std::string() : "'" + text + "' is not " + what;
  }));
};
inline const auto AboveZero = [](SettingRow & row) { CheckedAs(CLI::PositiveNumber, "a number above 0")(row); };
inline const auto NotBelowZero = [](SettingRow & row) { CheckedAs(CLI::NonNegativeNumber, "a number from 0 on")(row); };

inline const auto Excludes = [](const std::vector<std::string> & names) {
  return [names](SettingRow & row) { row.excludes = names; };
};
inline const auto Needs = [](const std::vector<std::string> & names) {
  return [names](SettingRow & row) { row.needs = names; };
};

/** The variable of the environment that is the default. */
inline const auto DefaultsTo = [](const std::string & variable) {
  return [variable](SettingRow & row) { row.option->envname(variable); };
};

/** \class Setting
 * \brief A row of a table of settings: names, member and help text, and traits if any.
 *
 * Names are those of CLI11: "-o,--output", or "SCAN" for a setting that is named by its place. Members are texts,
 * numbers, optional numbers and lists; a bool is set by its name alone. Defaults are the members' own. The name of a
 * list is repeated for each value, unless a trait says otherwise. */
template <typename TSettings>
struct Setting
{
  template <typename TMember, typename... TTraits>
  Setting(const std::string & names, TMember TSettings::*member, const std::string & help, TTraits... traits_)
    : addTo([=](CLI::App & parser, TSettings & settings) { return AddOption(parser, names, settings.*member, help); })
    , isNumber(IsNumber<TMember>)
    , traits{ traits_... }
  {}

  /** A member of a member. */
  template <typename TPart, typename TMember, typename... TTraits>
  Setting(const std::string & names,
          TPart TSettings::*part,
          TMember TPart::*member,
          const std::string & help,
          TTraits... traits_)
    : addTo(
        [=](CLI::App & parser, TSettings & settings) { return AddOption(parser, names, settings.*part.*member, help); })
    , isNumber(IsNumber<TMember>)
    , traits{ traits_... }
  {}

  std::function<CLI::Option *(CLI::App &, TSettings &)> addTo;
  bool isNumber;
  std::vector<SettingTrait> traits;

private:
  template <typename TMember>
  static constexpr bool IsNumber = !std::is_same_v<TMember, bool> && !std::is_same_v<TMember, std::string> &&
                                   !std::is_same_v<TMember, std::vector<std::string>>;

  template <typename TMember>
  static CLI::Option *
  AddOption(CLI::App & parser, const std::string & names, TMember & member, const std::string & help)
  {
    if constexpr (std::is_same_v<TMember, bool>)
    {
      return parser.add_flag(names, member, help);
    }
    else
    {
      return parser.add_option(names, member, help);
    }
  }
};

template <typename TSettings>
using SettingsTable = std::vector<Setting<TSettings>>;

/** \class CommandSettings
 * \brief The settings of a command, which a command line or JSON sets. JSON has their long names without dashes, or in
 * lower case for those named by their place; a setting without a value is true, a list is an array. */
class CommandSettings
{
public:
  /** \a parser must outlive this object. */
  explicit CommandSettings(CLI::App & parser)
    : m_Parser(parser)
  {}

  CommandSettings(const CommandSettings &) = delete;
  CommandSettings &
  operator=(const CommandSettings &) = delete;

  /** Adds the rows of a table, in the order of the help text. The members that they set must outlive this object. */
  template <typename TSettings>
  void
  Add(const SettingsTable<TSettings> & table, TSettings & settings)
  {
    for (const Setting<TSettings> & row : table)
    {
      this->AddRow(row.addTo(m_Parser, settings), row.isNumber, row.traits);
    }
  }

  /** Once all tables are added: relates the settings that exclude or need others. */
  void
  Relate();

  const std::string &
  GetCommand() const
  {
    return m_Parser.get_name();
  }

  /** All that are given, with paths and names of files. */
  Report
  Get() const;

  /** What reports hold of those that are given: no folders, nothing that may name the patient, nothing that does not
   * change what is made. */
  Report
  GetRecorded() const;

  /** The command line that a reader may type again, of the recorded settings: "rhombic render SCAN --preset=ct-bone".
   */
  std::string
  GetRecordedCommand() const;

  /** Sets those of \a settings that are not given yet. Throws CLI::ParseError as the parser does, and Failure(Usage)
   * for an unknown name. */
  void
  Set(const Report & settings);

  /** As Set(), of what GetRecorded() gave, but for scans, series and label maps, of which reports hold no names. Throws
   * Failure(Usage) where recorded label maps, or what colours come from, are not given. */
  void
  SetRecorded(Report settings);

  /** The names in JSON and the kinds of all settings but those that are hidden or named by their place. */
  std::vector<std::pair<std::string, SettingKind>>
  GetNames() const;

private:
  void
  AddRow(CLI::Option * option, bool isNumber, const std::vector<SettingTrait> & traits);

  CLI::App & m_Parser;
  std::vector<SettingRow> m_Rows;
};

/** The words that a setting takes, in the order in which messages list them, and their values. */
template <typename TValue>
using NamedValues = std::vector<std::pair<std::string, TValue>>;

/** The value of a word. Throws Failure(Usage) for other words, with the nearest word and all of them.
 * \param what a noun for the value, as "mode" */
template <typename TValue>
TValue
FindNamed(const std::string & what, const std::string & word, const NamedValues<TValue> & values)
{
  std::vector<std::string> names;
  for (const auto & [name, value] : values)
  {
    if (name == word)
    {
      return value;
    }
    names.push_back(name);
  }
  throw Failure(FailureKind::Usage, DescribeUnknown(what, word, names, "use " + Enumerate(names)));
}

} // namespace rhombic

#endif
