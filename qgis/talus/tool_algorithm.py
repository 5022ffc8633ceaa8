"""A tool as an algorithm: its parameters are made from its own description."""
import os
import re

from qgis.core import (QgsProcessing, QgsProcessingAlgorithm, QgsProcessingOutputNumber,
                       QgsProcessingParameterBoolean, QgsProcessingParameterDefinition, QgsProcessingParameterEnum,
                       QgsProcessingParameterFile, QgsProcessingParameterFileDestination,
                       QgsProcessingParameterFolderDestination, QgsProcessingParameterMapLayer,
                       QgsProcessingParameterMultipleLayers, QgsProcessingParameterNumber,
                       QgsProcessingParameterRasterDestination, QgsProcessingParameterString)

from . import running, tools


def label_of(option):
    words = option["help"]
    default = option.get("default", "")
    return words + (" (default: %s)" % default if default and option["role"] == "value" else "")


def destination_of(option, name, label, optional):
    if option["role"] == "output_folder":
        return QgsProcessingParameterFolderDestination(name, label, optional=optional, createByDefault=not optional)
    extension = tools.extension_of(option)
    if extension == "tif":
        return QgsProcessingParameterRasterDestination(name, label, optional=optional, createByDefault=not optional)
    return QgsProcessingParameterFileDestination(name, label, "%s (*.%s)" % (extension.upper(), extension) if extension
                                                 else "All files (*)", optional=optional,
                                                 createByDefault=not optional)


def value_of(option, name, label, optional):
    if option["several"]:
        return QgsProcessingParameterString(name, label + "; a line each", multiLine=True, optional=optional)
    if option.get("choices"):
        return QgsProcessingParameterEnum(name, label, option["choices"], usesStaticStrings=True, optional=optional)
    if option["type"] in ("number", "integer"):
        kind = (QgsProcessingParameterNumber.Double if option["type"] == "number"
                else QgsProcessingParameterNumber.Integer)
        return QgsProcessingParameterNumber(name, label, kind, optional=True)
    return QgsProcessingParameterString(name, label, optional=optional)


def parameter_of(option):
    """The parameter of QGIS for an option."""
    name, label, optional = tools.parameter_name(option), label_of(option), not option["required"]
    if option["role"] == "input" and option["several"]:
        return QgsProcessingParameterMultipleLayers(name, label, QgsProcessing.TypeFile, optional=optional)
    if option["role"] == "input" and tools.is_layer(option):
        return QgsProcessingParameterMapLayer(name, label, optional=optional)
    if option["role"] == "input":
        return QgsProcessingParameterFile(name, label, optional=optional)
    if option["role"].startswith("output"):
        return destination_of(option, name, label, optional)
    if option["role"] == "flag":
        return QgsProcessingParameterBoolean(name, label, defaultValue=False)
    return value_of(option, name, label, optional)


class ToolAlgorithm(QgsProcessingAlgorithm):
    def __init__(self, tool, command=None):
        super().__init__()
        self.tool, self.command = tool, command
        common = tools.common_keys(tool)
        self.options = tools.shown_options(tool, command)
        self.advanced = {o["key"] for o in self.options if o["key"] in common}

    def createInstance(self):
        return ToolAlgorithm(self.tool, self.command)

    def name(self):
        words = re.sub("^talus-", "", self.tool["tool"]).replace("-", "_")
        return words + ("_" + self.command["name"] if self.command else "")

    def displayName(self):
        return self.tool["tool"] + (" " + self.command["name"] if self.command else "")

    def group(self):
        return tools.group_of(self.tool["tool"])

    def groupId(self):
        return re.sub("[^a-z]", "_", self.group().lower())

    def shortDescription(self):
        return (self.command or self.tool)["purpose"]

    def shortHelpString(self):
        lines = [self.shortDescription(), ""]
        lines += ["<b>%s</b>: %s" % (o["spelling"], label_of(o)) for o in self.options]
        return "<br>".join(lines)

    def flags(self):
        # Some foreign processes are started from here: in the thread of a task, not in that of the
        # window.
        return super().flags() | QgsProcessingAlgorithm.FlagCanCancel

    def initAlgorithm(self, config=None):
        for option in self.options:
            parameter = parameter_of(option)
            if option["key"] in self.advanced:
                parameter.setFlags(parameter.flags() | QgsProcessingParameterDefinition.FlagAdvanced)
            self.addParameter(parameter)
        self.addOutput(QgsProcessingOutputNumber("EXIT_CODE", "Exit code"))

    def value(self, option, parameters, context, feedback):
        name = tools.parameter_name(option)
        if option["role"] == "flag":
            return self.parameterAsBool(parameters, name, context)
        if parameters.get(name) is None or parameters[name] == "":
            return None
        if option["role"] == "input" and option["several"]:
            return self.parameterAsFileList(parameters, name, context)
        if option["role"] == "input":
            return running.source_of(self, parameters, name, context, feedback)
        if option["role"] == "output" and tools.extension_of(option) == "tif":
            return self.parameterAsOutputLayer(parameters, name, context)
        if option["role"].startswith("output"):
            return self.parameterAsFileOutput(parameters, name, context)
        if option["several"]:
            return [line for line in self.parameterAsString(parameters, name, context).splitlines() if line.strip()]
        if option.get("choices"):
            return self.parameterAsEnumString(parameters, name, context)
        if option["type"] == "integer":
            return self.parameterAsInt(parameters, name, context)
        if option["type"] == "number":
            return self.parameterAsDouble(parameters, name, context)
        return self.parameterAsString(parameters, name, context)

    def processAlgorithm(self, parameters, context, feedback):
        from .provider import tools_folder
        values = {o["key"]: self.value(o, parameters, context, feedback) for o in self.options}
        program, arguments = tools.command_line(self.tool, values, tools_folder(), self.command)
        code, course = running.run(program, arguments, feedback)
        if code != 0 and not feedback.isCanceled():
            raise running.refusal(self.tool["tool"], code, course)
        results = {"EXIT_CODE": code}
        for option in self.options:
            path = values[option["key"]]
            if not option["role"].startswith("output") or not path or not os.path.exists(path):
                continue
            results[tools.parameter_name(option)] = path
            if not feedback.isCanceled():
                self.show(option, path, context)
        return results

    @staticmethod
    def show(option, path, context):
        if option["role"] == "output_folder":
            for name in sorted(os.listdir(path)):
                if name.endswith((".tif", ".gpkg")):
                    running.show(os.path.join(path, name), context)
        elif path.endswith(".gpkg"):
            running.show(path, context)
        else:
            running.style(path, context)
