"""A folder for another slope, with site.toml and site.gpkg."""
import os

from qgis.core import (QgsProcessingAlgorithm, QgsProcessingOutputFolder, QgsProcessingParameterFile,
                       QgsProcessingParameterMapLayer, QgsProcessingParameterString)

from . import running, tools


class NewSiteAlgorithm(QgsProcessingAlgorithm):
    def createInstance(self):
        return NewSiteAlgorithm()

    def name(self):
        return "new_site"

    def displayName(self):
        return "New site"

    def group(self):
        return "Site"

    def groupId(self):
        return "site"

    def shortHelpString(self):
        return ("Makes a folder with <b>site.toml</b>, a Makefile and <b>site.gpkg</b>, whose layers are loaded to be "
                "edited: source, fences, objects, grounds, forest, release points. Joint sets are fitted to the slope "
                "where a source is given, and are assumed until somebody has measured them.")

    def initAlgorithm(self, config=None):
        self.addParameter(QgsProcessingParameterFile("FOLDER", "Folder in which the site's folder is made",
                                                     behavior=QgsProcessingParameterFile.Folder))
        self.addParameter(QgsProcessingParameterString("NAME", "Name of the site: letters, digits, _ and -"))
        self.addParameter(QgsProcessingParameterMapLayer("GROUND", "Ground: elevation raster, or contour lines"))
        self.addParameter(QgsProcessingParameterMapLayer("SOURCE", "Release polygon; without it draw the source later",
                                                         optional=True))
        self.addOutput(QgsProcessingOutputFolder("SITE", "Folder of the site"))

    def file(self, parameters, name, context, feedback):
        if not parameters.get(name):
            return ""
        return running.source_of(self, parameters, name, context, feedback).split("|")[0]

    def processAlgorithm(self, parameters, context, feedback):
        from .provider import tools_folder
        site = os.path.join(self.parameterAsFile(parameters, "FOLDER", context),
                            self.parameterAsString(parameters, "NAME", context).strip())
        folder = tools_folder()
        if not tools.pipelines_folder(folder):
            running.run("", [], feedback)
        program, arguments = tools.new_site_command(site, self.file(parameters, "GROUND", context, feedback),
                                                    self.file(parameters, "SOURCE", context, feedback), folder)
        code, course = running.run(program, arguments, feedback)
        if code != 0:
            raise running.refusal("new site", code, course)
        layers = os.path.join(site, "site.gpkg")
        if os.path.exists(layers):
            running.show(layers, context)
        return {"SITE": site}
