"""A measure of a site: the section [variant.NAME] of site.toml, kept if `make check` accepts it."""
import os

from qgis.core import (QgsProcessing, QgsProcessingAlgorithm, QgsProcessingException, QgsProcessingOutputHtml,
                       QgsProcessingParameterFile, QgsProcessingParameterNumber, QgsProcessingParameterString,
                       QgsProcessingParameterVectorLayer, QgsProcessingUtils)

from . import running, site_file, tools


class MeasureAlgorithm(QgsProcessingAlgorithm):
    def createInstance(self):
        return MeasureAlgorithm()

    def name(self):
        return "measure"

    def displayName(self):
        return "Measure"

    def group(self):
        return "Site"

    def groupId(self):
        return "site"

    def shortHelpString(self):
        return ("Writes <b>[variant.NAME]</b> into site.toml: what differs from the site. A measure of that name is "
                "replaced; all other lines stay. <b>make check</b> then looks at the site with the measure. If it "
                "refuses, site.toml is as before.<br><br>A fence or dam of the site is changed by its name; with a "
                "line one is added. The line stays in its file, and may be edited there.<br><br>Other keys, a line "
                "each: forest.wood.stems_per_ha = 600. The site lacks what <b>Without</b> names: forest.wood (felled), "
                "rockfall.block (scaled off).<br><br><b>make report</b> computes all measures and compares them.")

    def flags(self):
        return super().flags() | QgsProcessingAlgorithm.FlagCanCancel

    def initAlgorithm(self, config=None):
        def number(name, label):
            self.addParameter(QgsProcessingParameterNumber(name, label, QgsProcessingParameterNumber.Double,
                                                           optional=True))

        self.addParameter(QgsProcessingParameterFile("SITE", "Folder of the site (with site.toml and Makefile)",
                                                     behavior=QgsProcessingParameterFile.Folder))
        self.addParameter(QgsProcessingParameterString("NAME", "Name of the measure: letters, digits, _ and -"))
        number("COST", "Cost, in any currency")
        for kind in ("fence", "dam"):
            self.addParameter(QgsProcessingParameterString(
                kind.upper(), "Name of a %s of the site, or of a new one (default: that of the measure)" % kind,
                optional=True))
            self.addParameter(QgsProcessingParameterVectorLayer(
                kind.upper() + "_LINE", "Line of the %s" % kind, [QgsProcessing.TypeVectorLine], optional=True))
            number(kind.upper() + "_HEIGHT_M", "Height of the %s above the ground [m]" % kind)
            number(kind.upper() + "_CAPACITY_KJ", "Energy that the %s takes [kJ]" % kind)
        self.addParameter(QgsProcessingParameterString("WITHOUT", "Without these sections of the site, a line each",
                                                       multiLine=True, optional=True))
        self.addParameter(QgsProcessingParameterString("OTHER", "Other keys, SECTION.NAME.KEY = VALUE, a line each",
                                                       multiLine=True, optional=True))
        self.addOutput(QgsProcessingOutputHtml("CHECK", "Check of the measure"))

    def file_of_line(self, parameters, name, site, context, feedback):
        path = running.source_of(self, parameters, name, context, feedback)
        if path.startswith(QgsProcessingUtils.tempFolder()):
            raise QgsProcessingException("%s: a temporary layer; make it permanent, e.g. in %s"
                                         % (name, os.path.join(site, "measures.gpkg")))
        return site_file.file_words(site, path)

    def section(self, name, site, parameters, context, feedback):
        """Lines of the section, as the parameters say."""
        def lines(key):
            return [line.strip() for line in self.parameterAsString(parameters, key, context).splitlines()
                    if line.strip()]

        def number(key):
            return None if parameters.get(key) is None else self.parameterAsDouble(parameters, key, context)

        values = [(["cost"], number("COST")), (["without"], lines("WITHOUT") or None)]
        for kind in ("fence", "dam"):
            its_name = self.parameterAsString(parameters, kind.upper(), context).strip() or name
            line = kind.upper() + "_LINE"
            if parameters.get(line):
                values.append(([kind, its_name, "file"],
                               self.file_of_line(parameters, line, site, context, feedback)))
            values += [([kind, its_name, key], number(kind.upper() + "_" + key.upper()))
                       for key in ("height_m", "capacity_kj")]
        return site_file.measure_section(name, values, lines("OTHER"))

    def processAlgorithm(self, parameters, context, feedback):
        site = self.parameterAsFile(parameters, "SITE", context)
        name = self.parameterAsString(parameters, "NAME", context).strip()
        file = os.path.join(site, "site.toml")
        try:
            section = self.section(name, site, parameters, context, feedback)
            before = site_file.text_of(file)
            after = site_file.with_measure(before, name, section)
            feedback.pushInfo("\n".join(section))
            site_file.write_text(file, after)
            accepted = False
            try:
                accepted = self.check(site, name, feedback)
            finally:
                if not accepted and site_file.text_of(file) == after:
                    site_file.write_text(file, before)
        except (OSError, ValueError) as error:
            raise QgsProcessingException(str(error))
        return {"CHECK": os.path.join(site, "out", "variant", name, "check.html")} if accepted else {}

    @staticmethod
    def check(site, name, feedback):
        """Whether the site and the measure pass `make check`; raises with its words, False: it was cancelled."""
        from .provider import tools_folder
        for variables in ([], ["VARIANT=" + name, "OUT=out/variant/" + name, "BASE=out"]):
            program, arguments = tools.goal_command(site, "check", variables, 1, tools_folder())
            code, course = running.run(program, arguments, feedback)
            if feedback.isCanceled():
                return False
            if code != 0:
                raise running.refusal("make check", code, course)
        return True
