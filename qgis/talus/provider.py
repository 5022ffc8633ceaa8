"""The provider: an algorithm a tool, an algorithm a goal of make, one for a new site, one for a measure."""
import os
import shlex

from qgis.core import QgsApplication, QgsProcessingProvider, QgsSettings
from qgis.PyQt.QtGui import QIcon

from . import tools
from .goal_algorithm import GoalAlgorithm
from .measure_algorithm import MeasureAlgorithm
from .new_site_algorithm import NewSiteAlgorithm
from .tool_algorithm import ToolAlgorithm

FOLDER_SETTING, COMMAND_SETTING = "TALUS_FOLDER", "TALUS_COMMAND"


def setting(name):
    return QgsSettings().value("Processing/Configuration/" + name, "", type=str)


def tools_folder():
    """Folder of the tools as set; empty: they are on the search path. Sets the command before them, too."""
    tools.before = shlex.split(setting(COMMAND_SETTING) or "")
    found = setting(FOLDER_SETTING)
    return found if found and (tools.before or os.path.isdir(found)) else ""


class TalusProvider(QgsProcessingProvider):
    def id(self):
        return "talus"

    def name(self):
        return "Talus"

    def longName(self):
        return "Talus rockslide hazard"

    def icon(self):
        return QIcon(os.path.join(os.path.dirname(__file__), "talus.svg"))

    def warningMessage(self):
        if tools.tool_path("talus-site", tools_folder()):
            return ""
        return ("The tools of Talus were not found: install the package talus, or name their folder under "
                "Settings, Options, Processing, Providers, Talus.")

    def load(self):
        self.add_settings()
        self.refreshAlgorithms()
        return True

    def add_settings(self):
        """The panel of settings belongs to a plugin that may be off; the setting itself does not need it."""
        try:
            from processing.core.ProcessingConfig import ProcessingConfig, Setting
        except ImportError:
            return
        ProcessingConfig.settingIcons["Talus"] = self.icon()
        ProcessingConfig.addSetting(Setting("Talus", FOLDER_SETTING,
                                            "Folder of the tools (empty: the search path)", "",
                                            valuetype=Setting.FOLDER))
        ProcessingConfig.addSetting(Setting("Talus", COMMAND_SETTING,
                                            "Command before the tools, e.g. wsl.exe (empty: none)", "",
                                            valuetype=Setting.STRING))
        ProcessingConfig.readSettings()

    def unload(self):
        try:
            from processing.core.ProcessingConfig import ProcessingConfig
            ProcessingConfig.removeSetting(FOLDER_SETTING)
            ProcessingConfig.removeSetting(COMMAND_SETTING)
        except (ImportError, KeyError):
            pass

    def loadAlgorithms(self):
        folder = tools_folder()
        cache = os.path.join(QgsApplication.qgisSettingsDirPath(), "talus_tools.json")
        for tool in tools.descriptions(folder, cache):
            for command in tool.get("commands", [None]):
                self.addAlgorithm(ToolAlgorithm(tool, command))
        goals = tools.goals(folder)
        for goal in goals:
            self.addAlgorithm(GoalAlgorithm(goal))
        if goals:
            self.addAlgorithm(MeasureAlgorithm())
        self.addAlgorithm(NewSiteAlgorithm())
