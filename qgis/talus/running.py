"""Runs a program as QGIS runs its own: messages and progress as they come, cancel at once."""
import os

from qgis.core import (QgsBlockingProcess, QgsProcessingContext, QgsProcessingException,
                       QgsProcessingLayerPostProcessorInterface, QgsProcessingUtils, QgsProviderRegistry)

from . import tools


class Course:
    """Messages of a running program, handed on to the log of the dialog."""

    def __init__(self, feedback):
        self.feedback, self.lines, self.faults, self.hints = feedback, [], [], []
        self.is_fault = False

    def take(self, line):
        self.lines.append(line)
        found = tools.said(line)
        if found is None:
            return
        if self.is_fault and line.startswith("  "):  # the message goes on, or its hint
            self.faults[-1] += "\n" + found.text
            self.feedback.reportError(found.text)
            return
        self.is_fault = found.kind == "error"
        if found.kind == "progress":
            self.feedback.setProgress(found.text)
        elif found.kind == "warning":
            self.feedback.pushWarning(found.text)
        elif found.kind == "error":
            self.faults.append(found.text)
            self.feedback.reportError(found.text)
        elif found.kind == "hint":
            self.hints.append(found.text)
            self.feedback.pushInfo("hint: " + found.text)
        else:
            self.feedback.pushInfo(found.text)


def run(program, arguments, feedback):
    """Exit code of the program and its messages. Raises QgsProcessingException when it cannot be started."""
    if not program:
        raise QgsProcessingException(
            "The tools of Talus were not found: install the package talus, or name their folder under Settings, "
            "Options, Processing, Providers, Talus.")
    program, *arguments = tools.started([program] + arguments)
    course = Course(feedback)
    out, err = tools.Lines(course.take), tools.Lines(course.take)
    feedback.pushCommandInfo(" ".join([program] + arguments))
    process = QgsBlockingProcess(program, arguments)
    # Both: with one missing QGIS 3.22 ends with std::bad_function_call. It holds no reference to them, and a
    # bound method that nobody holds is gone at once: these names keep it.
    take_out, take_err = out.add, err.add
    process.setStdOutHandler(take_out)
    process.setStdErrHandler(take_err)
    code = process.run(feedback)
    out.end()
    err.end()
    if process.processError() == 0:  # QProcess.FailedToStart
        raise QgsProcessingException(program + " could not be started")
    return code, course


def refusal(name, code, course):
    """The exception for an exit code other than 0, in the tool's own words."""
    words = course.faults[-3:] + ["hint: " + hint for hint in course.hints[-1:]]
    return QgsProcessingException("\n".join(["%s ended with exit code %d" % (name, code)] + words))


# --- layers --------------------------------------------------------------------------------------

def sources_in(path):
    """A source and a name for each layer of a file; tables without geometry are left out."""
    if path.lower().endswith(".tif"):
        return [(path, tools.layer_name(path))]
    found = []
    for layer in QgsProviderRegistry.instance().querySublayers(path):
        if layer.wkbType() != 100 and layer.name() != "layer_styles":  # 100: no geometry
            found.append((layer.uri(), layer.name().replace("_", " ")))
    return found


class OwnStyle(QgsProcessingLayerPostProcessorInterface):
    """Processing loads layers bare: the style lies beside the file, or in it."""

    def postProcessLayer(self, layer, context, feedback):
        layer.loadDefaultStyle()
        layer.triggerRepaint()


kept = []


def own_style():
    """One for each layer: the context deletes those of its layers, and Python must not do so before."""
    kept.append(OwnStyle())
    return kept[-1]


def show(path, context):
    """Has the layers of a file loaded when the algorithm has ended, with the styles that lie with them."""
    for source, name in sources_in(path):
        details = QgsProcessingContext.LayerDetails(name, context.project(), name)
        details.setPostProcessor(own_style())
        context.addLayerToLoadOnCompletion(source, details)


def style(path, context):
    """The same for a layer that QGIS loads itself, as the output of a parameter."""
    if context.willLoadLayerOnCompletion(path):
        context.layerToLoadOnCompletionDetails(path).setPostProcessor(own_style())


def path_of_layer(layer):
    """The file behind a layer as the tools take it, "a.gpkg|layername=b"; None where there is none."""
    provider = layer.dataProvider().name() if layer is not None and layer.dataProvider() is not None else ""
    return layer.source() if provider in ("gdal", "ogr") else None


def source_of(algorithm, parameters, name, context, feedback):
    """A layer or a file that a parameter names, as a file; a layer of memory becomes one."""
    value = parameters.get(name)
    if isinstance(value, str) and os.path.exists(value.split("|")[0]):
        return value
    layer = QgsProcessingUtils.mapLayerFromString(value, context) if isinstance(value, str) else value
    if layer is None:
        return algorithm.parameterAsFile(parameters, name, context)
    path = path_of_layer(layer)
    if path is not None:
        return path
    found = algorithm.parameterAsCompatibleSourceLayerPathAndLayerName(parameters, name, context, ["gpkg"], "gpkg",
                                                                       feedback)
    return found[0] + ("|layername=" + found[1] if found[1] else "")
