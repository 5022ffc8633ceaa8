"""A goal of make as an algorithm: the pipeline in a site's folder, or a part of it."""
import os
import shlex

from qgis.core import (QgsProcessingAlgorithm, QgsProcessingOutputHtml, QgsProcessingOutputNumber,
                       QgsProcessingException, QgsProcessingParameterFile, QgsProcessingParameterNumber,
                       QgsProcessingParameterString)

from . import running, tools


class GoalAlgorithm(QgsProcessingAlgorithm):
    def __init__(self, goal):
        super().__init__()
        self.goal = goal

    def createInstance(self):
        return GoalAlgorithm(self.goal)

    def name(self):
        return "make_" + self.goal.name.replace("-", "_")

    def displayName(self):
        return "make " + self.goal.name

    def group(self):
        return "Site"

    def groupId(self):
        return "site"

    def shortDescription(self):
        return self.goal.purpose

    def shortHelpString(self):
        return ("%s. Runs <b>make %s</b> in the folder of a site: what is up to date is not made again, and what was "
                "cancelled goes on where it was.<br><br>Variables of make stand a line each, e.g. RUNS=50 or "
                "SEED=3." % (self.goal.purpose, self.goal.name))

    def flags(self):
        return super().flags() | QgsProcessingAlgorithm.FlagCanCancel

    def initAlgorithm(self, config=None):
        self.addParameter(QgsProcessingParameterFile("SITE", "Folder of the site (with site.toml and Makefile)",
                                                     behavior=QgsProcessingParameterFile.Folder))
        self.addParameter(QgsProcessingParameterNumber("JOBS", "Runs side by side", defaultValue=1, minValue=1))
        self.addParameter(QgsProcessingParameterString("VARIABLES", "Variables of make, NAME=VALUE, a line each",
                                                       multiLine=True, optional=True))
        self.addOutput(QgsProcessingOutputNumber("EXIT_CODE", "Exit code of make"))
        self.addOutput(QgsProcessingOutputHtml("REPORT", "Report"))

    def variables(self, parameters, context):
        try:
            words = shlex.split(self.parameterAsString(parameters, "VARIABLES", context))
        except ValueError as error:
            raise QgsProcessingException("Variables: %s" % error)
        for word in words:
            if not word.split("=")[0].isidentifier() or "=" not in word:
                raise QgsProcessingException("Variables: \"%s\" is not NAME=VALUE, e.g. RUNS=50" % word)
        return words

    def processAlgorithm(self, parameters, context, feedback):
        from .provider import tools_folder
        site = self.parameterAsFile(parameters, "SITE", context)
        variables = self.variables(parameters, context)
        program, arguments = tools.goal_command(site, self.goal.name, variables,
                                                self.parameterAsInt(parameters, "JOBS", context), tools_folder())
        code, course = running.run(program, arguments, feedback)
        results = {"EXIT_CODE": code}
        if feedback.isCanceled():
            return results
        if code != 0 and not tools.has_failed_runs(course.lines):
            raise running.refusal("make " + self.goal.name, code, course)
        out = ([v[4:] for v in variables if v.startswith("OUT=")] or ["out"])[-1]
        folder = os.path.join(site, out)
        for file in tools.files_to_show(folder, self.goal.name):
            running.show(file, context)
        report = os.path.join(folder, "report.html")
        if self.goal.name in ("all", "report") and os.path.exists(report):
            results["REPORT"] = report
        return results
